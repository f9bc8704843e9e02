// Seven values of many engines at 720 crank angles: by hand, one register of designs at a time, with SLEEF's exp and log.
#include <cmath>
#include <immintrin.h>
#include <sleef.h>

#ifdef __AVX512F__
using Vector = __m512d;
enum { WIDTH = 8 };
static inline Vector of(double x) { return _mm512_set1_pd(x); }
static inline Vector root(Vector x) { return _mm512_sqrt_pd(x); }
static inline Vector largest(Vector a, Vector b) { return _mm512_max_pd(a, b); }
static inline Vector least(Vector a, Vector b) { return _mm512_min_pd(a, b); }
static inline Vector exponential(Vector x) { return Sleef_expd8_u10avx512f(x); }
static inline Vector logarithm(Vector x) { return Sleef_logd8_u10avx512f(x); }
static inline Vector load(const double *p) { return _mm512_loadu_pd(p); }
static inline void store(double *p, Vector x) { _mm512_storeu_pd(p, x); }
#else
using Vector = __m256d;
enum { WIDTH = 4 };
static inline Vector of(double x) { return _mm256_set1_pd(x); }
static inline Vector root(Vector x) { return _mm256_sqrt_pd(x); }
static inline Vector largest(Vector a, Vector b) { return _mm256_max_pd(a, b); }
static inline Vector least(Vector a, Vector b) { return _mm256_min_pd(a, b); }
static inline Vector exponential(Vector x) { return Sleef_expd4_u10avx2(x); }
static inline Vector logarithm(Vector x) { return Sleef_logd4_u10avx2(x); }
static inline Vector load(const double *p) { return _mm256_loadu_pd(p); }
static inline void store(double *p, Vector x) { _mm256_storeu_pd(p, x); }
#endif

enum { ANGLES = 720 };

// designs: radius, rod, bore, piston mass, speed, compression ratio, each of n; results: seven of n; n a multiple of WIDTH
extern "C" void engines(const double *x, double *out, long n, const double *sines, const double *cosines, double rod_mass)
{
    const double pi = std::acos(-1.0), step = 4 * pi / ANGLES;
    alignas(64) static thread_local double torques[ANGLES * WIDTH];
    for (long i = 0; i < n; i += WIDTH) {
        const Vector r = load(x + i), l = load(x + n + i), bore = load(x + 2 * n + i), piston = load(x + 3 * n + i);
        const Vector w = load(x + 4 * n + i), ratio = load(x + 5 * n + i), one = of(1.0), inf = of(INFINITY);
        const Vector area = of(pi / 4) * bore * bore, swept = area * of(2.0) * r, clearance = swept / (ratio - one);
        const Vector whole = logarithm(swept + clearance), small = logarithm(clearance), lambda = r / l;
        const Vector inertia = -(piston + of(rod_mass)) * w * w * r;
        Vector force_max = -inf, tangential_max = -inf, torque_max = -inf, torque_min = inf, sum = of(0.0), work = sum;
        Vector pressure_before = of(0.0), volume_before = of(0.0), first_pressure = of(0.0), first_volume = of(0.0);
        for (int j = 0; j < ANGLES; j++) {
            const Vector s = of(sines[j]), c = of(cosines[j]), sb = lambda * s;
            const Vector cb = root(one - sb * sb), per_cb = one / cb;
            const Vector volume = clearance + area * (r * (one - c) + l * (one - cb));
            Vector pressure;
            if (j <= 180)
                pressure = of(0.09e6);
            else if (j <= 360)
                pressure = of(0.09e6) * exponential(of(1.35) * (whole - logarithm(volume)));
            else if (j <= 540)
                pressure = of(5e6) * exponential(of(1.25) * (small - logarithm(volume)));
            else
                pressure = of(0.11e6);
            const Vector shape = (c * cb - s * sb) * per_cb + lambda * c * c * (per_cb * per_cb * per_cb);
            const Vector force = area * (pressure - of(0.1e6)) + inertia * shape;
            const Vector tangential = force * (s * cb + c * sb) * per_cb, torque = tangential * r;
            force_max = largest(force_max, force);
            tangential_max = largest(tangential_max, tangential);
            torque_max = largest(torque_max, torque);
            torque_min = least(torque_min, torque);
            sum += torque;
            if (j)
                work += of(0.5) * (pressure + pressure_before) * (volume - volume_before);
            else
                first_pressure = pressure, first_volume = volume;
            pressure_before = pressure;
            volume_before = volume;
            store(torques + j * WIDTH, torque);
        }
        work += of(0.5) * (first_pressure + pressure_before) * (first_volume - volume_before);
        const Vector mean = sum * of(1.0 / ANGLES);
        Vector energy = of(0.0), low = energy, high = energy, before = load(torques);
        for (int j = 0; j < ANGLES; j++) {
            const Vector after = load(torques + ((j + 1) % ANGLES) * WIDTH);
            energy += (of(0.5) * (before + after) - mean) * of(step);
            before = after;
            low = least(low, energy);
            high = largest(high, energy);
        }
        const Vector results[] = {force_max, tangential_max, mean, torque_max, torque_min, work,
                                  (high - low) / (of(0.01) * w * w)};
        for (int at = 0; at < 7; at++)
            store(out + at * n + i, results[at]);
    }
}
