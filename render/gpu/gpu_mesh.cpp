#include "render/gpu/gpu_mesh.h"

#include "render/gl/bindings.h"

#include <algorithm>
#include <limits>
#include <span>

namespace ramus::render {

namespace {

constexpr std::size_t kVertexPageBytes = sizeof(VertexPage::vertices);
constexpr std::size_t kValuePageBytes = sizeof(ValuePage::values);
constexpr std::size_t kCostOfFresh = 3;               // cost of writing fresh memory; measured on a software rasteriser
constexpr GLuint kVertexSource = 0, kValueSource = 1; // of a vertex array

std::size_t with_reserve(std::size_t pages) { return pages + pages / 8 + 1; }

template <class Pages> std::size_t differing(const Pages& have, const Pages& want) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < want.size(); ++i) count += have[i] != want[i] ? 1 : 0;
    return count;
}

// Sends differing pages in order until the budget is spent; true: none differ any more.
template <class Pages, class Bytes>
bool send_pages(GLuint buffer, Pages& have, const Pages& want, std::size_t& budget, const Bytes& bytes) {
    for (std::size_t i = 0; i < want.size(); ++i) {
        if (have[i] == want[i]) continue;
        if (budget == 0) return false;
        const std::span content(bytes(*want[i]));
        glNamedBufferSubData(buffer, static_cast<GLintptr>(i * content.size_bytes()),
                             static_cast<GLsizeiptr>(content.size_bytes()), content.data());
        have[i] = want[i];
        budget -= std::min(budget, content.size_bytes());
    }
    return true;
}

} // namespace

// Merges adjacent ranges.
void GpuMesh::Ranges::add(std::size_t first, std::size_t count, bool near) {
    constexpr std::size_t kPart = std::size_t{1} << 15; // triangles
    while (count > 0) {
        if (parts_.empty() || in_part_ == kPart || parts_.back().near != near) {
            parts_.push_back({counts_.size(), near});
            in_part_ = 0;
        }
        const std::size_t now = std::min(count, kPart - in_part_);
        if (in_part_ > 0 && end_ == first) {
            counts_.back() += static_cast<GLsizei>(3 * now);
        } else {
            counts_.push_back(static_cast<GLsizei>(3 * now));
            offsets_.push_back(offset_pointer(first * sizeof(glm::uvec3)));
        }
        first += now;
        count -= now;
        in_part_ += now;
        triangles_ += now;
        end_ = first;
    }
}

GpuMesh::Copy::Copy(const PagedMesh& mesh)
    : vertex_array(make_vertex_array()), vertex_pages(with_reserve(mesh.vertex_pages().size())),
      triangle_pages(with_reserve(mesh.triangle_pages().size())) {
    const PageMemory* memory = mesh.memory().get();
    if (memory != nullptr && memory->vertex_pages() >= mesh.vertex_pages().size() &&
        memory->triangle_pages() >= mesh.triangle_pages().size()) {
        vertex_pages.resize(memory->vertex_pages());
        triangle_pages.resize(memory->triangle_pages());
        bool shares_vertices = false, shares_triangles = false;
        vertices = LargeBuffer(*memory->vertices, shares_vertices);
        triangles = LargeBuffer(*memory->triangles, shares_triangles);
        for (std::size_t i = 0; shares_vertices && i < mesh.vertex_pages().size(); ++i)
            if (mesh.vertex_pages()[i].get() == memory->vertex_page(i)) vertex_pages[i] = mesh.vertex_pages()[i];
        for (std::size_t i = 0; shares_triangles && i < mesh.triangle_pages().size(); ++i)
            if (mesh.triangle_pages()[i]->triangles.data() == memory->triangle_page(i))
                triangle_pages[i] = mesh.triangle_pages()[i];
    } else {
        vertices = LargeBuffer(vertex_pages.size() * kVertexPageBytes);
        triangles = LargeBuffer(triangle_pages.size() * kTrianglePageBytes);
    }
    set_out();
}

void GpuMesh::Copy::set_out() {
    glVertexArrayVertexBuffer(vertex_array, kVertexSource, vertices, 0, sizeof(GpuVertex));
    glVertexArrayElementBuffer(vertex_array, triangles);
    glVertexArrayAttribFormat(vertex_array, kAttributePosition, 3, GL_FLOAT, GL_FALSE, offsetof(GpuVertex, position));
    glVertexArrayAttribFormat(vertex_array, kAttributeNormal, 3, GL_SHORT, GL_TRUE, offsetof(GpuVertex, normal));
    glVertexArrayAttribIFormat(vertex_array, kAttributeBranch, 1, GL_INT, offsetof(GpuVertex, branch));
    glVertexArrayAttribIFormat(vertex_array, kAttributeDominance, 4, GL_UNSIGNED_BYTE, offsetof(GpuVertex, dominance));
    use_attributes(vertex_array, {kAttributePosition, kAttributeNormal, kAttributeBranch, kAttributeDominance},
                   kVertexSource);
}

void GpuMesh::Copy::make_room_for_values() {
    if (values != 0) return;
    value_pages.resize(vertex_pages.size());
    values = LargeBuffer(value_pages.size() * kValuePageBytes);
    glVertexArrayVertexBuffer(vertex_array, kValueSource, values, 0, sizeof(float));
    glVertexArrayAttribFormat(vertex_array, kAttributeValue, 1, GL_FLOAT, GL_FALSE, 0);
    use_attributes(vertex_array, {kAttributeValue}, kValueSource);
}

std::size_t GpuMesh::Copy::bytes() const {
    return vertex_pages.size() * kVertexPageBytes + triangle_pages.size() * kTrianglePageBytes +
           value_pages.size() * kValuePageBytes;
}

std::size_t GpuMesh::bytes_of(const PagedMesh& mesh) {
    const std::size_t of_vertex_page = kVertexPageBytes + (mesh.has_values() ? kValuePageBytes : 0);
    return with_reserve(mesh.vertex_pages().size()) * of_vertex_page +
           with_reserve(mesh.triangle_pages().size()) * kTrianglePageBytes;
}

std::size_t GpuMesh::bytes() const {
    const auto of = [](const std::unique_ptr<Copy>& copy) { return copy ? copy->bytes() : 0; };
    return of(drawn_) + of(coming_) + of(near_copy_);
}

bool GpuMesh::Copy::fits(const PagedMesh& mesh) const {
    return mesh.vertex_pages().size() <= vertex_pages.size() && mesh.triangle_pages().size() <= triangle_pages.size();
}

std::size_t GpuMesh::Copy::missing(const PagedMesh& mesh) const {
    const std::size_t other_values =
        value_pages.empty() ? mesh.value_pages().size() : differing(value_pages, mesh.value_pages());
    return differing(vertex_pages, mesh.vertex_pages()) * kVertexPageBytes +
           differing(triangle_pages, mesh.triangle_pages()) * kTrianglePageBytes + other_values * kValuePageBytes;
}

bool GpuMesh::Copy::send(const PagedMesh& mesh, std::size_t& budget) {
    if (mesh.has_values()) make_room_for_values();
    return send_pages(
               vertices, vertex_pages, mesh.vertex_pages(), budget,
               [](const VertexPage& page) -> const auto& { return page.vertices; }) &&
           send_pages(
               triangles, triangle_pages, mesh.triangle_pages(), budget,
               [](const TrianglePage& page) -> const auto& { return page.triangles; }) &&
           send_pages(
               values, value_pages, mesh.value_pages(), budget,
               [](const ValuePage& page) -> const auto& { return page.values; });
}

void GpuMesh::follow(const std::shared_ptr<const PagedMesh>& mesh, std::size_t& budget) {
    if (mesh == shown_) {
        coming_.reset();
        return;
    }
    if (!mesh || (shown_ && shown_->origin() != mesh->origin())) {
        drawn_.reset();
        coming_.reset();
        show(nullptr);
        if (!mesh) return;
    }
    if (drawn_ && drawn_->fits(*mesh) && drawn_->missing(*mesh) <= budget) {
        (void)drawn_->send(*mesh, budget);
        coming_.reset();
        show(mesh);
        return;
    }
    if (!coming_ || !coming_->fits(*mesh)) coming_ = std::make_unique<Copy>(*mesh);
    // First writes to fresh memory cost more than copying.
    const std::size_t part = budget / kCostOfFresh + (budget % kCostOfFresh != 0 ? 1 : 0);
    std::size_t left = part;
    const bool whole = coming_->send(*mesh, left);
    budget -= part - left;
    if (!whole) return;
    drawn_ = std::move(coming_);
    show(mesh);
}

void GpuMesh::show(const std::shared_ptr<const PagedMesh>& mesh) {
    shown_ = mesh;
    near_ = {};
    if (!mesh) near_copy_.reset();
}

void GpuMesh::use_near_surface(NearSurface surface) {
    near_ = std::move(surface);
    if (!near_.mesh) return;
    if (!near_copy_ || !near_copy_->fits(*near_.mesh)) {
        near_copy_.reset();
        near_copy_ = std::make_unique<Copy>(*near_.mesh);
    }
    std::size_t budget = std::numeric_limits<std::size_t>::max();
    (void)near_copy_->send(*near_.mesh, budget);
}

template <class Call> void GpuMesh::for_pages(const glm::dmat4& to_clip, const Call& call) const {
    if (!shown_) return;
    const auto for_those_of = [&](const PagedMesh& mesh, bool near) {
        for (std::size_t i = 0; i < mesh.triangle_pages().size(); ++i) {
            const TrianglePage& page = *mesh.triangle_pages()[i];
            if (!near && near_.mesh && near_.replaced[i] != 0) continue;
            if (page.count > 0 && in_picture(page.lower, page.upper, to_clip))
                call(page, i * TrianglePage::kSize, near);
        }
    };
    for_those_of(*shown_, false);
    if (near_.mesh) for_those_of(*near_.mesh, true);
}

GpuMesh::Ranges GpuMesh::choose(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const {
    Ranges ranges;
    const bool all_opaque = std::ranges::all_of(layers, [](Layer l) { return l == Layer::kOpaque; });
    if (all_opaque && layer != Layer::kOpaque) return ranges;
    for_pages(to_clip, [&](const TrianglePage& page, std::size_t first, bool near) {
        if (all_opaque) return ranges.add(first, page.first_border, near);
        for (const TrianglePage::Run& run : page.runs)
            if (layer_of(layers, static_cast<std::size_t>(run.branch)) == layer)
                ranges.add(first + run.first, run.count, near);
    });
    return ranges;
}

GpuMesh::Ranges GpuMesh::choose_borders(const std::vector<Layer>& layers, Layer layer,
                                        const glm::dmat4& to_clip) const {
    Ranges ranges;
    const auto is_wanted = [&](std::int32_t branch) {
        return layer_of(layers, static_cast<std::size_t>(branch)) == layer;
    };
    for_pages(to_clip, [&](const TrianglePage& page, std::size_t first, bool near) {
        if (std::ranges::any_of(page.borders,
                                [&](const auto& pair) { return is_wanted(pair[0]) || is_wanted(pair[1]); }))
            ranges.add(first + page.first_border, page.count - page.first_border, near);
    });
    return ranges;
}

void GpuMesh::draw_part(const Ranges& ranges, std::size_t part) const {
    const auto [begin, near] = ranges.parts_[part];
    const std::size_t end = part + 1 < ranges.parts() ? ranges.parts_[part + 1].begin : ranges.counts_.size();
    glBindVertexArray((near ? near_copy_ : drawn_)->vertex_array);
    glMultiDrawElements(GL_TRIANGLES, &ranges.counts_[begin], GL_UNSIGNED_INT, &ranges.offsets_[begin],
                        static_cast<GLsizei>(end - begin));
}

std::uint64_t GpuMesh::draw(const Ranges& ranges) const {
    for (std::size_t part = 0; part < ranges.parts(); ++part) draw_part(ranges, part);
    return ranges.triangles();
}

std::uint64_t GpuMesh::triangles_in_picture(const glm::dmat4& to_clip) const {
    std::uint64_t count = 0;
    for_pages(to_clip, [&](const TrianglePage& page, std::size_t, bool) { count += page.count; });
    return count;
}

} // namespace ramus::render
