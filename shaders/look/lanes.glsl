// The language of this folder's files, for GLSL. The formulas of the look are written once: for the shaders, and for
// render/caster/glsl-inl.h, where a Float is a vector of pixels. Values that may differ between pixels have the types
// below; uniforms and constants are float, vec4 and uint.
//
// - Numbers have the suffix F.
// - `if` takes a condition that is equal for all pixels, or ANY(mask): whether it may be true for some pixel. Inside,
//   as everywhere, select(mask, a, b) chooses per pixel.
// - with_sign(a, b) is a with the sign of b; a must be positive.
// - mad(a, b, c) is a * b + c, in one step if the processor supports it; reciprocal(x) has a relative error of up to
//   1e-7, rough_inversesqrt(x) of 4e-4.
#define INLINE
#define Float float
#define Uint uint
#define Mask bool
#define Vec2 vec2
#define Vec3 vec3
#define Vec4 vec4
#define ANY(mask) (mask)
#define select(mask, a, b) ((mask) ? (a) : (b))
#define mad(a, b, c) ((a) * (b) + (c))
#define reciprocal(x) (1.0 / (x))
#define rough_inversesqrt(x) inversesqrt(x)

float with_sign(float size, float of) { return of >= 0.0 ? size : -size; }
bool has(uint bits, uint bit) { return (bits & bit) != 0u; }
