// Values of many engines at 720 crank angles: by hand, one register of designs at a time, with SLEEF's exp and log.
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

// one cylinder: of a design, and at a crank angle
struct Cylinder {
    Vector r, l, w, area, clearance, whole, small, lambda, inertia;
    Vector cb, sb, per_cb, volume, pressure, force;

    Cylinder(const double *x, long n, double rod_mass)
    {
        const Vector bore = load(x + 2 * n), piston = load(x + 3 * n), ratio = load(x + 5 * n), one = of(1.0);
        r = load(x), l = load(x + n), w = load(x + 4 * n);
        area = of(std::acos(-1.0) / 4) * bore * bore;
        const Vector swept = area * of(2.0) * r;
        clearance = swept / (ratio - one);
        whole = logarithm(swept + clearance), small = logarithm(clearance), lambda = r / l;
        inertia = -(piston + of(rod_mass)) * w * w * r;
    }

    inline void at(int j, Vector s, Vector c)
    {
        const Vector one = of(1.0);
        sb = lambda * s;
        cb = root(one - sb * sb), per_cb = one / cb;
        volume = clearance + area * (r * (one - c) + l * (one - cb));
        if (j <= 180)
            pressure = of(0.09e6);
        else if (j <= 360)
            pressure = of(0.09e6) * exponential(of(1.35) * (whole - logarithm(volume)));
        else if (j <= 540)
            pressure = of(5e6) * exponential(of(1.25) * (small - logarithm(volume)));
        else
            pressure = of(0.11e6);
        const Vector shape = (c * cb - s * sb) * per_cb + lambda * c * c * (per_cb * per_cb * per_cb);
        force = area * (pressure - of(0.1e6)) + inertia * shape;
    }
};

// designs: radius, rod, bore, piston mass, speed, compression ratio, each of n; results: seven of n; n a multiple of WIDTH
extern "C" void engines(const double *x, double *out, long n, const double *sines, const double *cosines, double rod_mass,
                        double pin_mass)
{
    const double step = 4 * std::acos(-1.0) / ANGLES;
    alignas(64) static thread_local double torques[ANGLES * WIDTH], inertias[ANGLES * WIDTH];
    for (long i = 0; i < n; i += WIDTH) {
        Cylinder a(x + i, n, rod_mass);
        const Vector moved = load(x + i + 3 * n) + of(rod_mass), turned = of(pin_mass) * a.r * a.r;
        const Vector inf = of(INFINITY);
        Vector force_max = -inf, tangential_max = -inf, torque_max = -inf, torque_min = inf, sum = of(0.0), work = sum;
        Vector pressure_before = of(0.0), volume_before = of(0.0), first_pressure = of(0.0), first_volume = of(0.0);
        for (int j = 0; j < ANGLES; j++) {
            const Vector s = of(sines[j]), c = of(cosines[j]);
            a.at(j, s, c);
            const Vector share = (s * a.cb + c * a.sb) * a.per_cb, rate = share * a.r;
            const Vector tangential = a.force * share, torque = tangential * a.r;
            force_max = largest(force_max, a.force);
            tangential_max = largest(tangential_max, tangential);
            torque_max = largest(torque_max, torque);
            torque_min = least(torque_min, torque);
            sum += torque;
            if (j)
                work += of(0.5) * (a.pressure + pressure_before) * (a.volume - volume_before);
            else
                first_pressure = a.pressure, first_volume = a.volume;
            pressure_before = a.pressure;
            volume_before = a.volume;
            store(torques + j * WIDTH, a.area * (a.pressure - of(0.1e6)) * rate);
            store(inertias + j * WIDTH, moved * rate * rate + turned);
        }
        work += of(0.5) * (first_pressure + pressure_before) * (first_volume - volume_before);
        const Vector mean = sum * of(1.0 / ANGLES), half = of(0.5) * a.w * a.w;
        const Vector upper = half * of(1.005 * 1.005), lower = half * of(0.995 * 0.995);
        Vector gas = of(0.0), energy = gas, low = inf, high = -inf, before = load(torques);
        for (int j = 0; j < ANGLES; j++)
            gas += load(torques + j * WIDTH);
        gas *= of(1.0 / ANGLES);
        for (int j = 0; j < ANGLES; j++) {
            const Vector after = load(torques + ((j + 1) % ANGLES) * WIDTH), inertia = load(inertias + j * WIDTH);
            low = least(low, energy - lower * inertia);
            high = largest(high, energy - upper * inertia);
            energy += (of(0.5) * (before + after) - gas) * of(step);
            before = after;
        }
        const Vector results[] = {force_max, tangential_max, mean, torque_max, torque_min, work,
                                  (high - low) / (of(0.01) * a.w * a.w)};
        for (int at = 0; at < 7; at++)
            store(out + at * n + i, results[at]);
    }
}

// A V8 of such cylinders, two on each of four crankpins at 0, 90, 270 and 180 degrees, five main journals: largest and
// least torque, largest loads of crankpins 1 and 4 and of the mains, nine of n. A rod has a mass at its crankpin.
extern "C" void v8(const double *x, double *out, long n, const double *sines, const double *cosines, double rod_mass,
                   double pin_mass)
{
    static const int after[4][2] = {{0, 90}, {270, 360}, {450, 540}, {180, 630}};
    alignas(64) static thread_local double across[ANGLES * WIDTH], along[ANGLES * WIDTH];
    for (long i = 0; i < n; i += WIDTH) {
        Cylinder a(x + i, n, rod_mass);
        const Vector thrown = of(pin_mass) * a.r * a.w * a.w, inf = of(INFINITY);
        for (int j = 0; j < ANGLES; j++) {
            const Vector s = of(sines[j]), c = of(cosines[j]);
            a.at(j, s, c);
            const Vector pushed = a.force * a.per_cb;
            store(across + j * WIDTH, pushed * (s * a.cb + c * a.sb));
            store(along + j * WIDTH, pushed * (c * a.cb - s * a.sb) - thrown);
        }
        Vector torque_max = -inf, torque_min = inf, first = of(0.0), fourth = first, mains[5];
        for (auto &one : mains)
            one = of(0.0);
        for (int j = 0; j < ANGLES; j++) {
            Vector T[4], K[4];
            for (int pin = 0; pin < 4; pin++) {
                int one = j - after[pin][0], other = j - after[pin][1];
                one += one < 0 ? ANGLES : 0, other += other < 0 ? ANGLES : 0;
                T[pin] = load(across + one * WIDTH) + load(across + other * WIDTH);
                K[pin] = load(along + one * WIDTH) + load(along + other * WIDTH);
            }
            // the second and third are those of the first, later
            first = largest(first, T[0] * T[0] + K[0] * K[0]);
            fourth = largest(fourth, T[3] * T[3] + K[3] * K[3]);
            const Vector torque = (T[0] + T[1] + T[2] + T[3]) * a.r;
            torque_max = largest(torque_max, torque);
            torque_min = least(torque_min, torque);
            // in the frame of the first crank
            const Vector X[4] = {K[0], T[1], -T[2], -K[3]}, Y[4] = {T[0], -K[1], K[2], -T[3]};
            for (int main = 0; main < 5; main++) {
                const Vector u = main == 0 ? X[0] : main == 4 ? X[3] : X[main - 1] + X[main];
                const Vector v = main == 0 ? Y[0] : main == 4 ? Y[3] : Y[main - 1] + Y[main];
                mains[main] = largest(mains[main], u * u + v * v);
            }
        }
        store(out + i, torque_max);
        store(out + n + i, torque_min);
        store(out + 2 * n + i, root(first));
        store(out + 3 * n + i, root(fourth));
        for (int at = 0; at < 5; at++)
            store(out + (4 + at) * n + i, of(0.5) * root(mains[at]));
    }
}
