// Section across a subduction zone, on both sides of a curved plate interface. Lengths in km; x is landward from the trench, y up.
// gmsh -2 subduction.geo -format msh41 -o subduction.msh makes the mesh of scenes/subduction.toml.
// The interface follows depth = 0.085 x + 0.00096 x^2 down to 51 km, and goes on at a constant dip to the lower side.
Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 1;
Mesh.Algorithm = 6;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

fine = 2;       // cells along the interface where it slips
depth = 200;    // of the lower side
left = -400;
right = 700;

// Points of the interface every 10 km to x = 190 km, and straight on.
n = 19;
For k In {0:n}
  x = 10 * k;
  Point(100 + k) = {x, -(0.085 * x + 0.00096 * x * x), 0};
EndFor
slope = 0.085 + 2 * 0.00096 * 190;
bottom = 190 + (depth - (0.085 * 190 + 0.00096 * 190 * 190)) / slope;
Point(200) = {bottom, -depth, 0};
Point(1) = {left, 0, 0};
Point(2) = {right, 0, 0};
Point(3) = {right, -depth, 0};
Point(4) = {left, -depth, 0};

Spline(1) = {100:100 + n};
Line(2) = {100 + n, 200};
Line(3) = {1, 100};
Line(4) = {100, 2};
Line(5) = {2, 3};
Line(6) = {3, 200};
Line(7) = {200, 4};
Line(8) = {4, 1};
Curve Loop(1) = {3, 1, 2, 7, 8};
Curve Loop(2) = {4, 5, 6, -2, -1};
Plane Surface(1) = {1};
Plane Surface(2) = {2};

// Cells grow with the distance from the interface.
Field[1] = Distance;
Field[1].CurvesList = {1};
Field[1].Sampling = 400;
Field[2] = MathEval;
Field[2].F = Sprintf("Min(40, %g + 0.2 * F1)", fine);
Background Field = 2;

Physical Surface("slab", 1) = {1};
Physical Surface("wedge", 2) = {2};
Physical Curve("interface", 3) = {1, 2};
Physical Curve("sea", 4) = {3};
Physical Curve("land", 5) = {4};
Physical Curve("landward", 6) = {5};
Physical Curve("below wedge", 7) = {6};
Physical Curve("below slab", 8) = {7};
Physical Curve("seaward", 9) = {8};
