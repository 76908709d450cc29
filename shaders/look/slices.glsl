// Slices of a scan: what the samples of a pixel see of the planes. C++ compiles this file for one pixel at a time. The
// includer has plane_texel(plane, at, size), the filtered picture at `at` (0 to 1, premultiplied sRGB), and sample_offset(s),
// the position of a sample from the pixel's middle.

struct Slices {
    float value[kMostSamples]; // in the depth buffer, larger is nearer; kNoSlice: no slice
    vec3 colour[kMostSamples]; // sRGB
};

vec4 plane_row(int plane, int row) { return plane_rows[kPlaneRows * plane + row]; }
float at_pixel(vec4 row, vec2 pixel) { return row.x * pixel.x + row.y * pixel.y + row.z; }

bool in_box(int plane, vec2 pixel) {
    vec4 box = plane_row(plane, 5);
    return pixel.x > box.x && pixel.y > box.y && pixel.x < box.z && pixel.y < box.w;
}

bool in_plane(int plane, vec2 pixel) {
    float weight = at_pixel(plane_row(plane, 2), pixel);
    float across = at_pixel(plane_row(plane, 0), pixel), down = at_pixel(plane_row(plane, 1), pixel);
    return weight > 0.0F && min(across, down) >= 0.0F && max(across, down) <= weight;
}

// A place in the picture of a plane, and how it changes per pixel to the right and upward.
struct SlicePlace {
    vec2 at, right, up; // 0 to 1
    vec2 size;          // of the picture, its pixels
};

SlicePlace slice_place(int plane, vec2 pixel) {
    vec4 across = plane_row(plane, 0), down = plane_row(plane, 1), weights = plane_row(plane, 2);
    float per_weight = 1.0F / max(at_pixel(weights, pixel), 1e-30F);
    SlicePlace place;
    place.at = per_weight * vec2(at_pixel(across, pixel), at_pixel(down, pixel));
    place.right = per_weight * vec2(across.x - place.at.x * weights.x, down.x - place.at.y * weights.x);
    place.up = per_weight * vec2(across.y - place.at.x * weights.y, down.y - place.at.y * weights.y);
    place.size = vec2(across.w, down.w);
    return place;
}

// The picture under a pixel: straight colour, and alpha sharpened so that its edge is a pixel wide. Where the picture
// is reduced, it is the mean of several places in the pixel.
vec4 slice_colour(int plane, SlicePlace place, bool any) {
    float reach = max(length(place.right * place.size), length(place.up * place.size));
    float taps = reach > 1.05F ? clamp(ceil(reach), 2.0F, 4.0F) : 1.0F;
    float step = 1.0F / taps, first = 0.5F * step - 0.5F, x = first, y = first;
    vec4 sum = vec4(0.0F);
    for (int k = any ? int(taps * taps) : 0; k > 0; --k) { // row by row; whole numbers are slow to divide
        sum += plane_texel(plane, place.at + x * place.right + y * place.up, place.size);
        x += step;
        y += x > 0.5F ? step : 0.0F;
        x = x > 0.5F ? first : x;
    }
    sum *= step * step;
    float alpha = clamp((sum.w - 0.5F) / clamp(reach, 1e-3F, 1.0F) + 0.5F, 0.0F, 1.0F);
    return vec4(vec3(sum) / max(sum.w, 1e-3F), alpha);
}

// What a pixel shows where that is simple: one slice over all samples, or none.
struct SimpleSlice {
    int plane;           // -1: none
    float value, change; // in the depth buffer, at the pixel's middle; the most that samples differ from it
    SlicePlace place;
    bool mixed;          // edges, outlines or several slices: see slices_at()
};

// Slices behind `farthest`, a value in the depth buffer, do not count. `planes` is their number.
SimpleSlice simple_slice_at(vec2 middle, int planes, float farthest) {
    vec2 in_first_view = middle + vec2(plane_counts.y, plane_counts.z);
    SimpleSlice found;
    found.plane = -1;
    found.value = kNoSlice;
    found.change = 0.0F;
    found.place.at = found.place.right = found.place.up = found.place.size = vec2(0.0F);
    found.mixed = false;
    for (int i = 0; i < planes; ++i) {
        vec4 values = plane_row(i, 3), first = plane_row(i, 12);
        float inside = min(min(at_pixel(first, middle), at_pixel(plane_row(i, 13), middle)),
                           min(at_pixel(plane_row(i, 14), middle), at_pixel(plane_row(i, 15), middle)));
        float value = at_pixel(values, middle), weight = at_pixel(plane_row(i, 2), middle);
        bool near = in_box(i, middle), before = value + first.w >= farthest;
        // Samples are less than 0.75 pixels from the middle.
        bool covers = near && inside > 0.75F && weight > 0.0F && plane_row(i, 0).w > 0.0F;
        // An outline has the depth of its edge, which may be nearer.
        bool at_edge = near && !covers && inside > -(values.w + 1.0F) && (before || values.w > 0.0F);
        bool close = covers && before && found.plane >= 0 && abs(value - found.value) <= found.change + first.w;
        found.mixed = found.mixed || at_edge || close;
        bool nearer = covers && value > found.value;
        SlicePlace here = slice_place(i, in_first_view);
        found.plane = nearer ? i : found.plane;
        found.value = nearer ? value : found.value;
        found.change = nearer ? first.w : found.change;
        found.place.at = nearer ? here.at : found.place.at;
        found.place.right = nearer ? here.right : found.place.right;
        found.place.up = nearer ? here.up : found.place.up;
        found.place.size = nearer ? here.size : found.place.size;
    }
    return found;
}

Slices slices_at(vec2 pixel, int samples) {
    Slices found;
    for (int s = 0; s < kMostSamples; ++s) {
        found.value[s] = kNoSlice;
        found.colour[s] = vec3(0.0F);
    }
    int planes = int(plane_counts.x);
    for (int i = 0; i < planes; ++i) {
        vec4 values = plane_row(i, 3);
        bool near = in_box(i, pixel), inside[kMostSamples];
        int covered = 0;
        for (int s = 0; s < kMostSamples; ++s) {
            inside[s] = near && s < samples && in_plane(i, pixel + sample_offset(s));
            covered += inside[s] ? 1 : 0;
        }
        SlicePlace place = slice_place(i, pixel + vec2(plane_counts.y, plane_counts.z));
        vec4 colour = slice_colour(i, place, covered > 0 && place.size.x > 0.0F);
        for (int s = 0; s < kMostSamples; ++s) {
            float value = at_pixel(values, pixel + sample_offset(s));
            bool seen = inside[s] && colour.w * float(samples) > float(s) + 0.5F && value > found.value[s];
            found.value[s] = seen ? value : found.value[s];
            found.colour[s] = seen ? vec3(colour) : found.colour[s];
        }
        // The nearest edge whose outline reaches the pixel. Loops of no steps instead of branches: a software
        // rasteriser leaves loops early.
        int edges = near && covered < samples && values.w > 0.0F ? 4 : 0;
        vec4 from_values = plane_row(i, 6), to_values = plane_row(i, 7);
        float edge_value = kNoSlice;
        vec2 edge_point = vec2(0.0F), outward = vec2(0.0F);
        for (int k = 0; k < edges; ++k) {
            vec4 edge = plane_row(i, 8 + k);
            vec2 from = vec2(edge.x, edge.y), way = vec2(edge.z, edge.w) - from;
            float along = clamp(dot(pixel - from, way) / max(dot(way, way), 1e-12F), 0.0F, 1.0F);
            vec2 point = from + along * way, away = pixel - point;
            float apart = length(away), value = mix(from_values[k], to_values[k], along);
            bool nearer = apart < values.w + 0.75F && value > edge_value;
            edge_value = nearer ? value : edge_value;
            edge_point = nearer ? point : edge_point;
            outward = nearer ? away / max(apart, 1e-6F) : outward;
        }
        vec3 ink = vec3(plane_row(i, 4));
        for (int s = 0; s < kMostSamples; ++s) {
            bool seen = edges > 0 && s < samples && !inside[s] && edge_value > found.value[s] &&
                        dot(pixel + sample_offset(s) - edge_point, outward) <= values.w;
            found.value[s] = seen ? edge_value : found.value[s];
            found.colour[s] = seen ? ink : found.colour[s];
        }
    }
    return found;
}
