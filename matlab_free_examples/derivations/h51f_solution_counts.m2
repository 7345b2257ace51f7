-- Numbers of solutions of H51f (five viewing rays, one 3D point, unknown focal length) for every way in which the rays may share
-- centres, over a finite field, with random data.
--
--   M2 --script h51f_solution_counts.m2
--
-- Unknowns x, y, a, b, d. With the origin of the rig's frame at the 3D point, seen at pi0 (pib0), and
--
--   u(w) = w+ - 2 x w3 - x^2 w-,   v(w) = w- - 2 y w3 - y^2 w+,   s(w) = w3 + x w- + y w+ - x y w3,   w+- = w1 +- i w2,
--
-- a ray through c with direction q and moment m = q x c, seen at pi (pib), gives
--
--   2 s(m) + a pib u(m) + b pi v(m) + i a d (pib0 - pib) u(q) - i b d (pi0 - pi) v(q) + i a b d (pib pi0 - pi pib0) s(q) = 0.
--
-- The query's viewing direction is n = (x+y, -i(x-y), 1-xy)/(1+xy), z = f (r1 + i r2) = (1-x^2, i(1+x^2), -2x)/(b (1+xy)), zb =
-- (1-y^2, -i(1+y^2), -2y)/(a (1+xy)), f^2 = 1/(a b), and d is the depth of the 3D point. Not solutions: a b d (1+xy) = 0, and the
-- query at a centre that several rays share, where n.c + d = z.c + d pi0 = zb.c + d pib0 = 0.
p = 30013
setRandomSeed 20261122
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
    (ideal equations, shared))

report = I -> if dim I > 0 then "a curve" else toString degree I

for pattern in {{1,1,1,1,1}, {2,1,1,1}, {2,2,1}, {3,1,1}, {3,2}, {4,1}} do (
    (I, shared) := system pattern;
    I = saturate(I, a*b*d*(1 + x*y));
    before := report I;
    for J in shared do I = saturate(I, J);
    print(toString pattern | ": " | before | ", without the query at a shared centre: " | report I))
