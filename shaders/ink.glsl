// Colours of lines over the picture: light with a dark edge, readable over vessels and any background.
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(location = kUniformToInner) uniform vec2 to_inner; // pixels of the picture to those of what was drawn

layout(location = 0) out vec4 colour;

// Distance in mm behind the visible surface at this pixel.
float mm_behind(float depth) { return depth - texelFetch(opaque_depth, ivec2(gl_FragCoord.xy * to_inner), 0).x; }

// `across`: pixels from the middle of the line.
vec4 inked(vec3 ink, float across, float half_width, float edge) {
    float light = clamp(half_width - abs(across) + 0.5, 0.0, 1.0);
    float dark = edge * clamp(half_width - abs(across) + 1.5, 0.0, 1.0) * (1.0 - light);
    return vec4(light * ink + dark * vec3(0.04), light + dark);
}
