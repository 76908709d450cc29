// A surface point: input of all formulas of the look.
struct SurfacePoint {
    Uint id;           // as in ids.glsl
    Uint flags;        // of its branch's record; 0 on a context mesh
    Mask fixed_colour; // of a context mesh: neither depth nor values change its colour
    Vec3 albedo;       // linear
    Vec3 normal;       // y up, z towards the eye
    Vec3 position;     // eye space with depth as +z, mm
    Vec3 towards_eye;  // of unit length, z towards the eye
    Float far;         // 0 at the near end of the tree, 1 at its far end
    Vec2 pixel;        // position in the picture
    Float value;       // of the surface; in the caster: on the colour scale or, if any branch is cut, mm from the root
};
