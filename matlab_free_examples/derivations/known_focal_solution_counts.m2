-- Numbers of solutions with known focal length (f = 1): four viewing rays and one 3D point, for every way in which the rays may share
-- centres; two rays and two points; three points. Over a finite field, with random data.
--
--   M2 --script known_focal_solution_counts.m2
--
-- Four rays and a point: unknowns and equations are those of h51f_solution_counts.m2, with a b = 1 in addition. Points: depths along the
-- bearings and, for the rays, the turn about the line of the two points (src/doc/known_focal.md).
p = 30013
setRandomSeed 20261128
k = ZZ/p
-- i^2 = -1: p = 1 modulo 4
unit = first select(1..p-1, j -> (j*j + 1) % p == 0)
R = k[x, y, a, b, d]
i = unit_R

dot = (v, w) -> v#0*w#0 + v#1*w#1 + v#2*w#2
cross = (v, w) -> {v#1*w#2 - v#2*w#1, v#2*w#0 - v#0*w#2, v#0*w#1 - v#1*w#0}
randomVector = () -> apply(3, j -> random(k)*1_R)

u = w -> w#0 + i*w#1 - 2*x*w#2 - x^2*(w#0 - i*w#1)
v = w -> w#0 - i*w#1 - 2*y*w#2 - y^2*(w#0 + i*w#1)
s = w -> w#2 + x*(w#0 - i*w#1) + y*(w#0 + i*w#1) - x*y*w#2

-- The ideal of the equations, and the ideals of the queries at shared centres (denominators removed).
system = pattern -> (
    (pi0, pib0) = (random(k)*1_R, random(k)*1_R);
    equations := {}; shared := {};
    for count in pattern do (
        c := randomVector();
        for j from 1 to count do (
            q := randomVector(); m := cross(q, c);
            (pi1, pib1) := (random(k)*1_R, random(k)*1_R);
            equations = append(equations,
                2*s(m) + a*pib1*u(m) + b*pi1*v(m) + i*a*d*(pib0 - pib1)*u(q) - i*b*d*(pi0 - pi1)*v(q)
                + i*a*b*d*(pib1*pi0 - pi1*pib0)*s(q)));
        if count > 1 then shared = append(shared, ideal(
            s(c) + d*(1 + x*y), u(c) + d*pi0*b*(1 + x*y), v(c) + d*pib0*a*(1 + x*y))));
    (ideal append(equations, a*b - 1), shared))

report = I -> if dim I > 0 then "a curve" else toString degree I

for pattern in {{1,1,1,1}, {2,1,1}, {2,2}, {3,1}, {4}} do (
    (I, shared) := system pattern;
    I = saturate(I, a*b*d*(1 + x*y));
    before := report I;
    for J in shared do I = saturate(I, J);
    print(toString pattern | ": " | before | ", without the query at a shared centre: " | report I))

-- Three points: depths l1, l2, l3. Half of the solutions are the others with all depths negative.
S = k[l1, l2, l3]
some = () -> random(k)*1_S
print("three points: " | toString degree ideal(
    l1^2 + l2^2 - 2*some()*l1*l2 - some(), l1^2 + l3^2 - 2*some()*l1*l3 - some(), l2^2 + l3^2 - 2*some()*l2*l3 - some()))

-- Two points and two rays: (c, s) = (cos, sin) of theta, (e, g) of psi; a ray has A e + B g + K = 0. The components of the data by u, e1, e2
-- and b1, b2, N are free, those of k = v x a2 follow from v and a2 = (-sin, cos, 0) of gamma/2.
T = k[c, s, e, g]
anyNumber = () -> random(k)*1_T
-- A point of the circle, for gamma/2.
t = random(k)
coefficients2 = (cosHalf, sinHalf) -> (
    (m, q, v) := (apply(3, j -> anyNumber()), apply(3, j -> anyNumber()), apply(3, j -> anyNumber()));
    a2 := {-sinHalf, cosHalf, 0_T};
    w := {v#1*a2#2 - v#2*a2#1, v#2*a2#0 - v#0*a2#2, v#0*a2#1 - v#1*a2#0};
    L := (c*cosHalf - s*sinHalf);
    (vg, vh) := (c*v#0 + s*v#1, c*v#1 - s*v#0);
    (kg, kh) := (c*w#0 + s*w#1, c*w#1 - s*w#0);
    (m#1*vh + m#2*v#2 + L*(q#1*kh + q#2*w#2))*e + (m#1*v#2 - m#2*vh + L*(q#1*w#2 - q#2*kh))*g + m#0*vg + L*q#0*kg)
cosHalf = ((1 - t^2)/(1 + t^2))*1_T
sinHalf = (2*t/(1 + t^2))*1_T
print("two points and two rays: " | toString degree ideal(
    c^2 + s^2 - 1, e^2 + g^2 - 1, coefficients2(cosHalf, sinHalf), coefficients2(cosHalf, sinHalf)))
