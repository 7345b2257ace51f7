-- The numbers of h51f_solution_counts.m2 again, from other equations: the unknown is the query's camera matrix, and no
-- parametrisation of rotations is used.
--
--   M2 --script h51f_camera_matrix_counts.m2
--
-- A = diag(f, f, 1) R up to scale: the rows are orthogonal, the first two of equal length. With the origin of the rig's frame at
-- the 3D point, seen at p0, the query's matrix is (A | d p0), and a ray through c with direction q, seen at p, gives
-- det(p, A q, A c + d p0) = 0. Not solutions: det A = 0, d = 0, and the query at a shared centre, A c + d p0 = 0.
p = 30013
setRandomSeed 20261122
k = ZZ/p
R = k[a_1..a_9, d]
A = matrix{{a_1, a_2, a_3}, {a_4, a_5, a_6}, {a_7, a_8, a_9}}

randomVector = () -> matrix apply(3, j -> {random(k)*1_R})
row = j -> transpose A^{j}
dot = (v, w) -> (transpose v * w)_(0,0)

system = pattern -> (
    p0 := randomVector();
    scale := sum(9, j -> random(k)*a_(j+1)) - 1;
    equations := {dot(row 0, row 0) - dot(row 1, row 1), dot(row 0, row 1), dot(row 0, row 2), dot(row 1, row 2), scale};
    shared := {};
    for count in pattern do (
        c := randomVector();
        for j from 1 to count do equations = append(equations, det(randomVector() | A*randomVector() | A*c + d*p0));
        if count > 1 then shared = append(shared, ideal flatten entries (A*c + d*p0)));
    (ideal equations, shared))

report = I -> if dim I > 0 then "a curve" else toString degree I

for pattern in {{1,1,1,1,1}, {2,1,1,1}, {2,2,1}, {3,1,1}, {3,2}, {4,1}} do (
    (I, shared) := system pattern;
    I = saturate(saturate(I, det A), d);
    before := report I;
    for J in shared do I = saturate(I, J);
    print(toString pattern | ": " | before | ", without the query at a shared centre: " | report I))
