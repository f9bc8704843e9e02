% One engine over 0..720 degrees at 0.01 degree: gas pressure, inertia force, their sum, T, Z, N, volume,
% displacement, velocity and acceleration, vectorised piece by piece. Written from the formulas of the
% two-term crank gear; the indicator diagram is that of examples/spark-engine.toml.
1;
function [out] = engine()
  R = 5.29; D = 10.58; lambda = 0.25; Vc = 120; n = 2300;
  F = D ^ 2 * pi / 4;
  volume = @(a) F * R * (1 - cosd(a) + lambda / 4 * (1 - cosd(2 * a))) + Vc;
  a1 = 0:0.01:5;        p1 = interp1([0 2.5 5], [0.11 0.103 0.08], a1, 'spline');
  a2 = 5:0.01:180;      p2 = linspace(0.08, 0.08, numel(a2));
  a3 = 180:0.01:350;    p3 = 0.08 * (1050 ./ volume(a3)) .^ 1.372;
  a4 = 350:0.01:360;    p4 = interp1([350 355 360], [1.42322 1.75322 2.42322], a4, 'spline');
  a5 = 360:0.01:375;    p5 = interp1([360 365 370 375], [4.5083 5.083 5.083 4.95844679], a5, 'pchip');
  a6 = 375:0.01:505;    p6 = 5.98 * (120 ./ volume(a6)) .^ 1.23;
  a7 = 505:0.01:540;    p7 = interp1([505 510 535 540], [0.44883 0.4412 0.234576 0.182478], a7, 'spline');
  a8 = 540:0.01:550;    p8 = interp1([540 545 550], [0.182478 0.15 0.11], a8, 'spline');
  a9 = 550:0.01:720;    p9 = linspace(0.11, 0.11, numel(a9));
  a = [a1 a2 a3 a4 a5 a6 a7 a8 a9];
  Pkt = [p1 p2 p3 p4 p5 p6 p7 p8 p9];
  v = volume(a);
  Pj = -23.27 * R * 1e-2 * (pi * n / 30) ^ 2 * (cosd(a) + lambda * cosd(2 * a)) * 1e-5;
  P1 = Pkt + Pj;
  T = P1 .* sind(a + asind(lambda .* sind(a))) ./ cosd(asind(lambda .* sind(a)));
  Z = P1 .* cosd(a + asind(lambda .* sind(a))) ./ cosd(asind(lambda .* sind(a)));
  N = P1 .* tand(asind(lambda .* sind(a)));
  vt = R * 1e-2 * (2 * pi * n / 60) * (sind(a) + lambda / 2 * sind(2 * a));
  j = R * 1e-2 * (2 * pi * n / 60) ^ 2 * (cosd(a) + lambda * cosd(2 * a));
  out = [Pkt(end) Pj(end) P1(end) T(end) Z(end) N(end) v(end) vt(end) j(end) max(T)];
endfunction
repeats = 15;
engine();
times = zeros(1, repeats);
for k = 1:repeats
  start = cputime; result = engine(); times(k) = cputime - start;
endfor
printf("%.6f %.6f\n", min(times), result(end));
