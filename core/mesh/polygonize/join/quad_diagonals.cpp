#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mesh/polygonize/join/quad_diagonals.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/mesh/polygonize/join/edge_polygons.h"

#include <algorithm>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::mesh::bricks::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

struct Vector3 {
    V x, y, z;
};
HWY_INLINE Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector3 operator+(const Vector3& a, const Vector3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V dot(const Vector3& a, const Vector3& b) {
    return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE Vector3 cross(const Vector3& a, const Vector3& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

// Loads the vectors of the c-th vertices of as many quads as there are lanes. Reads `Numbers` floats of each vertex: 4
// is a single load that reads one float beyond the vertex, 3 stays within it. A load per vertex and a transposition are
// several times as fast as a gather on processors that gather element by element.
template <std::size_t Numbers>
HWY_INLINE Vector3 read_corner(D d, const glm::vec3* values, const std::uint32_t* quads, std::size_t c) {
    const auto at = [&](std::size_t i) { return &values[quads[4 * i + c]].x; };
#if HWY_TARGET == HWY_SCALAR
    return {hn::Set(d, at(0)[0]), hn::Set(d, at(0)[1]), hn::Set(d, at(0)[2])};
#else
    const hn::CappedTag<float, 4> block;
    const auto vertex = [&](std::size_t i) {
        if constexpr (Numbers == 4) return hn::LoadU(block, at(i));
        HWY_ALIGN float copy[4] = {at(i)[0], at(i)[1], at(i)[2], 0.0F};
        return hn::Load(block, copy);
    };
    // Every fourth vertex from the i-th on, a block each.
    const auto blocks = [&](std::size_t i) {
        if constexpr (HWY_MAX_BYTES == 64) {
            const hn::CappedTag<float, 8> half;
            return hn::Combine(d, hn::Combine(half, vertex(i + 12), vertex(i + 8)),
                               hn::Combine(half, vertex(i + 4), vertex(i)));
        } else if constexpr (HWY_MAX_BYTES == 32) {
            return hn::Combine(d, vertex(i + 4), vertex(i));
        } else {
            return vertex(i);
        }
    };
    const hn::RepartitionToWide<D> pair;
    const V v0 = blocks(0), v1 = blocks(1), v2 = blocks(2), v3 = blocks(3);
    const auto xy01 = hn::BitCast(pair, hn::InterleaveLower(d, v0, v1)),
               xy23 = hn::BitCast(pair, hn::InterleaveLower(d, v2, v3));
    const auto z01 = hn::BitCast(pair, hn::InterleaveUpper(d, v0, v1)),
               z23 = hn::BitCast(pair, hn::InterleaveUpper(d, v2, v3));
    return {hn::BitCast(d, hn::InterleaveLower(pair, xy01, xy23)),
            hn::BitCast(d, hn::InterleaveUpper(pair, xy01, xy23)), hn::BitCast(d, hn::InterleaveLower(pair, z01, z23))};
#endif
}

// Whether the diagonal from the first vertex to the third is the better one. A diagonal whose triangles do not face
// away from the surface is preferred; otherwise the one closer to the surface. The distance of a chord from the surface
// is its length times the angle between the normals, over 8.
HWY_INLINE M prefers_first(D d, const Vector3 (&p)[4], const Vector3 (&n)[4]) {
    const Vector3 d02 = p[2] - p[0];
    const Vector3 d13 = p[3] - p[1];
    const V l02 = dot(d02, d02);
    const V l13 = dot(d13, d13);
    const V size = hn::Sqrt(hn::Max(l02, l13));
    // On a flat surface both chords lie on it, and the shorter diagonal gives better shaped triangles.
    const V flat = hn::Set(d, 0.02F);
    const V off02 = hn::MulAdd(hn::Abs(dot(d02, n[2] - n[0])), size, hn::Mul(flat, l02));
    const V off13 = hn::MulAdd(hn::Abs(dot(d13, n[3] - n[1])), size, hn::Mul(flat, l13));
    const M closer02 = hn::Lt(off02, off13);
    // Signed squares of the triangles' areas, seen from outside: negative or small if a triangle faces away, or nearly.
    // The minimum of a diagonal's two triangles is used.
    const Vector3 facing = (n[0] + n[1]) + (n[2] + n[3]);
    const auto score = [&](const Vector3& area) {
        const V along = dot(area, facing);
        return hn::Mul(along, hn::Abs(along));
    };
    const V worst02 = hn::Min(score(cross(p[1] - p[0], d02)), score(cross(d02, p[3] - p[0])));
    const V worst13 = hn::Min(score(cross(p[2] - p[1], d13)), score(cross(d13, p[0] - p[1])));
    // A tenth of the area of a square on the diagonals; tuned on real trees.
    const V enough = hn::Mul(hn::Set(d, 0.01F), hn::Mul(hn::Mul(l02, l13), dot(facing, facing)));
    const M better02 = hn::Gt(worst02, worst13);
    const M fair = hn::Ge(hn::IfThenElse(closer02, worst02, worst13), enough);
    return hn::Or(hn::And(fair, closer02), hn::AndNot(fair, better02));
}

void cut_quads(const VertexSpan& vertices, const glm::uvec4* quads, std::size_t count, glm::uvec3* triangles) {
    const D d;
    const DU du;
    const std::size_t lanes = hn::Lanes(d);
    const glm::vec3* positions = vertices.positions.data();
    const glm::vec3* normals = vertices.normals.data();
    const auto last_vertex = hn::Set(du, static_cast<std::uint32_t>(vertices.size() - 1));
    HWY_ALIGN std::uint32_t buffer[6 * HWY_MAX_BYTES / 4];
    for (std::size_t q = 0; q < count; q += lanes) {
        const std::size_t valid = std::min(lanes, count - q);
        HWY_ALIGN std::uint32_t padded[4 * HWY_MAX_BYTES / 4];
        const std::uint32_t* from = &quads[q].x;
        if (valid < lanes) {
            for (std::size_t i = 0; i < lanes; ++i)
                for (int c = 0; c < 4; ++c)
                    padded[4 * i + static_cast<std::size_t>(c)] = quads[q + std::min(i, valid - 1)][c];
            from = padded;
        }
        hn::Vec<DU> v[4];
        hn::LoadInterleaved4(du, from, v[0], v[1], v[2], v[3]);
        const auto last = hn::Max(hn::Max(v[0], v[1]), hn::Max(v[2], v[3]));
        if (q + 4 * lanes <= count) { // two opposite corners of quads to come: their neighbours lie in the same lines
            for (const glm::uvec4& ahead : std::span(quads + q + 3 * lanes, lanes)) {
                for (const std::uint32_t corner : {ahead.x, ahead.z}) {
                    __builtin_prefetch(positions + corner);
                    __builtin_prefetch(normals + corner);
                }
            }
        }
        Vector3 p[4];
        Vector3 n[4];
        const bool readable = hn::AllTrue(du, hn::Lt(last, last_vertex));
        for (std::size_t c = 0; c < 4; ++c) {
            p[c] = readable ? read_corner<4>(d, positions, from, c) : read_corner<3>(d, positions, from, c);
            n[c] = readable ? read_corner<4>(d, normals, from, c) : read_corner<3>(d, normals, from, c);
        }
        const auto first = hn::RebindMask(du, prefers_first(d, p, n));
        const auto a = hn::IfThenElse(first, v[0], v[1]);
        const auto b = hn::IfThenElse(first, v[1], v[2]);
        const auto c = hn::IfThenElse(first, v[2], v[3]);
        const auto e = hn::IfThenElse(first, v[3], v[0]);
        std::uint32_t* out = valid < lanes ? buffer : &triangles[2 * q].x;
        hn::StoreInterleaved3(a, b, c, du, out);
        hn::StoreInterleaved3(a, c, e, du, out + 3 * lanes);
        if (valid == lanes) continue;
        for (std::size_t i = 0; i < valid; ++i)
            for (std::size_t half = 0; half < 2; ++half) {
                const std::uint32_t* t = buffer + 3 * (i + half * lanes);
                triangles[2 * (q + i) + half] = {t[0], t[1], t[2]};
            }
    }
}

} // namespace ramus::mesh::bricks::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::mesh::bricks {

HWY_EXPORT(cut_quads);

void cut_quads(const VertexSpan& vertices, std::span<const glm::uvec4> quads, std::span<glm::uvec3> triangles) {
    static_assert(sizeof(glm::uvec4) == 16 && sizeof(glm::uvec3) == 12 && sizeof(glm::vec3) == 12);
    if (quads.empty()) return;
    HWY_DYNAMIC_DISPATCH(cut_quads)(vertices, quads.data(), quads.size(), triangles.data());
}

} // namespace ramus::mesh::bricks
#endif
