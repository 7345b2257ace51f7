-- Numbers of solutions of H70f (seven viewing rays, unknown focal length) for every way in which the rays may share at least two
-- centres, over a finite field, with random data.
--
--   M2 --script h70f_solution_counts.m2
--
-- Unknowns x, y, tb, t, d (third component of the translation), a, b. With
--
--   u(w) = w+ - 2 x w3 - x^2 w-,   v(w) = w- - 2 y w3 - y^2 w+,   s(w) = w3 + x w- + y w+ - x y w3,   w+- = w1 +- i w2,
--
-- a ray through c with direction q and moment m = q x c, seen at pi (pib), gives, A = a pib, B = b pi,
--
--   2 s(m) + A u(m) + B v(m) + i tb (u(q) - B s(q)) - i t (v(q) - A s(q)) - i d (A u(q) - B v(q)) = 0.
--
-- See h51f_solution_counts.m2 for x, y, a, b. Not solutions: a b (1+xy) = 0, and the query at a centre c that three or more rays
-- share, where t (1+xy) + u(c) = tb (1+xy) + v(c) = d (1+xy) + s(c) = 0. Both are removed by one more unknown w and the equation
-- w a b (1+xy) e = 1, e a product of random combinations of those conditions.
p = 30013
setRandomSeed 20261128
k = ZZ/p
-- i^2 = -1: p = 1 modulo 4
unit = first select(1..p-1, j -> (j*j + 1) % p == 0)
R = k[x, y, tb, t, d, a, b, w]
i = unit_R

cross = (v, w) -> {v#1*w#2 - v#2*w#1, v#2*w#0 - v#0*w#2, v#0*w#1 - v#1*w#0}
randomVector = () -> apply(3, j -> random(k)*1_R)

u = w -> w#0 + i*w#1 - 2*x*w#2 - x^2*(w#0 - i*w#1)
v = w -> w#0 - i*w#1 - 2*y*w#2 - y^2*(w#0 + i*w#1)
s = w -> w#2 + x*(w#0 - i*w#1) + y*(w#0 + i*w#1) - x*y*w#2

rayEquation = c -> (
    q := randomVector(); m := cross(q, c);
    (A, B) := (a*random(k), b*random(k));
    2*s(m) + A*u(m) + B*v(m) + i*tb*(u(q) - B*s(q)) - i*t*(v(q) - A*s(q)) - i*d*(A*u(q) - B*v(q)))

queryAt = c -> random(k)*(t*(1 + x*y) + u(c)) + random(k)*(tb*(1 + x*y) + v(c)) + random(k)*(d*(1 + x*y) + s(c))

system = pattern -> (
    equations := {}; improper := a*b*(1 + x*y);
    for count in pattern do (
        -- the first centre is the origin
        c := if equations == {} then apply(3, j -> 0_R) else randomVector();
        for j from 1 to count do equations = append(equations, rayEquation c);
        if count > 2 then improper = improper*queryAt c);
    ideal append(equations, w*improper - 1))

for pattern in {{6,1}, {5,2}, {5,1,1}, {4,3}, {4,2,1}, {4,1,1,1}, {3,3,1}, {3,2,2}, {3,2,1,1}, {3,1,1,1,1}, {2,2,2,1}, {2,2,1,1,1},
    {2,1,1,1,1,1}, {1,1,1,1,1,1,1}} do (
    I := ideal groebnerBasis(system pattern, Strategy => "F4");
    print(toString pattern | ": " | (if dim I > 0 then "infinitely many" else toString degree I)))
