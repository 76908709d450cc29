// A point of a surface, as all formulas of a look take it.
struct SurfacePoint {
    Uint id;           // as in ids.glsl
    Uint flags;        // of its branch's record; 0 on a context mesh
    Mask fixed_colour; // of a context mesh: its colour stays as it was chosen
    Vec3 albedo;       // linear
    Vec3 normal;       // y up, z towards the eye
    Vec3 position;     // eye space with depth as +z, mm
    Vec3 towards_eye;  // of unit length, z towards the eye
    Float far;         // 0 at the near end of the tree, 1 at its far end
    Vec2 pixel;        // where it is seen
    Float value;       // the surface's own; the caster's: on the scale of colours or, when any branch is cut, mm from the root
};
