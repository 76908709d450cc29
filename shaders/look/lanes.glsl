// The language of this folder's files, for GLSL. They hold the formulas of a look, once for the shaders and once more
// compiled by render/caster/glsl-inl.h, where a Float is a vector of pixels. What may differ from pixel to pixel is
// written in the types below, what is the same for all (uniforms, constants) in float, vec4 and uint.
//
// - Numbers have the suffix F.
// - `if` takes what is the same for all pixels, or ANY(mask): whether there may be a pixel where it is true. Inside, as
//   everywhere, select(mask, a, b) says what each pixel gets.
// - with_sign(a, b) is a with the sign of b, a being positive.
// - mad(a, b, c) is a * b + c, in one step where the processor has it; reciprocal(x) may be off by 1e-7 of its value,
//   rough_inversesqrt(x) by 4e-4.
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
