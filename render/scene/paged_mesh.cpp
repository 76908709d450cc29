#include "render/scene/paged_mesh.h"

#include "core/base/free_in_background.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <utility>

namespace ramus::render {

namespace {

std::int16_t normalised(float v) {
    const float scaled = std::clamp(v, -1.0F, 1.0F) * 32767.0F;
    return static_cast<std::int16_t>(scaled + (scaled < 0.0F ? -0.5F : 0.5F));
}

// Area-weighted vertex normals for a mesh without normals.
LargeArray<glm::vec3> normals_of(const mesh::TriangleMesh& mesh) {
    LargeArray<glm::vec3> normals(mesh.positions.size(), glm::vec3(0.0F));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 n =
            glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
        for (int i = 0; i < 3; ++i) normals[t[i]] += n;
    }
    for (glm::vec3& n : normals) n = glm::length(n) > 0.0F ? glm::normalize(n) : glm::vec3(0, 0, 1);
    return normals;
}

// The input of pages.
struct Source {
    const mesh::TriangleMesh& mesh;
    const LargeArray<glm::vec3>& normals;
    glm::dvec3 origin;

    [[nodiscard]] std::int32_t branch(std::size_t vertex) const {
        return mesh.branches.empty() ? 0 : std::max(mesh.branches[vertex], 0);
    }
    [[nodiscard]] field::Dominance dominance(std::size_t vertex) const {
        return mesh.dominance.empty() ? field::Dominance{{255, 255}, {0, 0}} : mesh.dominance[vertex];
    }
    [[nodiscard]] glm::vec3 position(std::size_t vertex) const { return {glm::dvec3(mesh.positions[vertex]) - origin}; }
};

// In the page's place in `memory`; if that is null, allocated separately.
std::shared_ptr<const VertexPage> make_vertex_page(const Source& source, std::size_t page,
                                                   const std::shared_ptr<const PageMemory>& memory) {
    const auto made = memory ? std::shared_ptr<VertexPage>(memory, memory->vertex_page(page))
                             : std::make_shared_for_overwrite<VertexPage>();
    const std::size_t first = page * VertexPage::kSize;
    const std::size_t count = std::min(VertexPage::kSize, source.mesh.positions.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3& n = source.normals[first + i];
        made->vertices[i] = {source.position(first + i),
                             source.branch(first + i),
                             source.dominance(first + i),
                             {normalised(n.x), normalised(n.y), normalised(n.z), 0}};
    }
    std::fill(made->vertices.begin() + static_cast<std::ptrdiff_t>(count), made->vertices.end(), GpuVertex{});
    return made;
}

// Records the branches that meet in a triangle, if its corners have different ones.
void note_borders(const glm::ivec3& branches, std::vector<std::array<std::int32_t, 2>>& borders) {
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(branches[k], branches[(k + 1) % 3]);
        const std::array pair{low, high};
        if (low != high && std::ranges::find(borders, pair) == borders.end()) borders.push_back(pair);
    }
}

std::shared_ptr<glm::uvec3> triangles_of_page(std::size_t page, const std::shared_ptr<const PageMemory>& memory) {
    if (memory) return {memory, memory->triangle_page(page)};
    const auto own = std::make_shared_for_overwrite<std::array<glm::uvec3, TrianglePage::kSize>>();
    return {own, own->data()};
}

std::shared_ptr<const TrianglePage> make_triangle_page(const Source& source, std::size_t page,
                                                       const std::shared_ptr<const PageMemory>& memory) {
    const auto made = std::make_shared<TrianglePage>();
    const std::shared_ptr<glm::uvec3> triangles = triangles_of_page(page, memory);
    const std::size_t first = page * TrianglePage::kSize;
    const std::size_t end = std::min(first + TrianglePage::kSize, source.mesh.triangles.size());
    std::array<glm::uvec3, TrianglePage::kSize> whole, on_border; // NOLINT: written as far as they are read
    std::array<std::uint32_t, TrianglePage::kSize> run_of;        // NOLINT
    std::vector<TrianglePage::Run>& runs = made->runs;
    std::uint32_t run = 0, border_count = 0;
    for (std::size_t i = first; i < end; ++i) {
        const glm::uvec3& t = source.mesh.triangles[i];
        if (t.x == t.y) continue; // a gap
        const std::array<glm::vec3, 3> at{source.position(t.x), source.position(t.y), source.position(t.z)};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::vec3& p = at.at(corner);
            made->longest_edge = std::max(made->longest_edge, glm::distance(p, at.at((corner + 1) % 3)));
            const bool first_corner = made->first_border + border_count == 0 && corner == 0;
            made->lower = first_corner ? p : glm::min(made->lower, p);
            made->upper = first_corner ? p : glm::max(made->upper, p);
        }
        const glm::ivec3 branches(source.branch(t.x), source.branch(t.y), source.branch(t.z));
        if (branches.x != branches.y || branches.y != branches.z) {
            note_borders(branches, made->borders);
            on_border[border_count++] = t;
            continue;
        }
        const std::int32_t branch = branches.x;
        // Triangles come in runs of one branch, and a page has few branches.
        if (run >= runs.size() || runs[run].branch != branch) {
            run =
                static_cast<std::uint32_t>(std::ranges::find(runs, branch, &TrianglePage::Run::branch) - runs.begin());
            if (run == runs.size()) runs.push_back({branch, 0, 0});
        }
        ++runs[run].count;
        whole[made->first_border] = t;
        run_of[made->first_border++] = run;
    }
    // A counting sort keeps the triangles' order within each branch, and with it the vertices' locality.
    std::uint32_t next = 0;
    for (TrianglePage::Run& r : runs) {
        r.first = next;
        next += std::exchange(r.count, 0);
    }
    for (std::uint32_t i = 0; i < made->first_border; ++i) {
        TrianglePage::Run& r = runs[run_of[i]];
        triangles.get()[r.first + r.count++] = whole[i];
    }
    std::copy_n(on_border.begin(), border_count, triangles.get() + made->first_border);
    made->count = made->first_border + border_count;
    std::fill(triangles.get() + made->count, triangles.get() + TrianglePage::kSize, glm::uvec3(0));
    made->triangles = {triangles.get(), TrianglePage::kSize};
    made->memory = triangles;
    return made;
}

// Whether more than a third of the pages would be outside the mesh's memory after this many were written: such pages
// cost memory in addition to those they replace, for the mesh and for a copy that shares it.
bool lies_apart(const PagedMesh& mesh, std::size_t written) {
    const PageMemory& memory = *mesh.memory();
    std::size_t apart = written;
    for (std::size_t i = 0; i < mesh.vertex_pages().size(); ++i)
        apart += mesh.vertex_pages()[i].get() != memory.vertex_page(i) ? 1 : 0;
    for (std::size_t i = 0; i < mesh.triangle_pages().size(); ++i) {
        const auto& page = mesh.triangle_pages()[i];
        apart += !page || page->triangles.data() != memory.triangle_page(i) ? 1 : 0;
    }
    return 3 * apart > mesh.vertex_pages().size() + mesh.triangle_pages().size();
}

std::size_t pages_for(std::size_t count, std::size_t size) { return (count + size - 1) / size; }

// Indices of the pages that the ranges touch, ascending.
std::vector<std::size_t> touched(std::span<const mesh::SlotRange> ranges, std::size_t size, std::size_t page_count) {
    std::vector<std::uint8_t> marked(page_count, 0);
    for (const mesh::SlotRange& range : ranges)
        for (std::size_t page = range.first / size; page * size < range.first + range.count && page < page_count;
             ++page)
            marked[page] = 1;
    std::vector<std::size_t> pages;
    for (std::size_t page = 0; page < page_count; ++page)
        if (marked[page] != 0) pages.push_back(page);
    return pages;
}

} // namespace

std::shared_ptr<const PageMemory> PageMemory::make(std::size_t vertex_pages, std::size_t triangle_pages) {
    const auto with_room = [](std::size_t pages) { return pages + pages / 8 + 1; };
    auto vertices = SharedPages::make(with_room(vertex_pages) * sizeof(VertexPage));
    auto triangles = SharedPages::make(with_room(triangle_pages) * kTrianglePageBytes);
    if (!vertices || !triangles) return nullptr;
    return std::make_shared<const PageMemory>(PageMemory{std::move(vertices), std::move(triangles)});
}

PagedMesh::PagedMesh(const mesh::TriangleMesh& mesh) : PagedMesh(mesh, bounds_of(mesh).centre()) {}

PagedMesh::PagedMesh(const mesh::TriangleMesh& mesh, const glm::dvec3& origin) : origin_(origin) {
    mesh::SurfaceEdit all;
    all.whole = true;
    *this = edited(mesh, all);
}

PagedMesh PagedMesh::edited(const mesh::TriangleMesh& mesh, const mesh::SurfaceEdit& edit) const {
    PagedMesh next;
    next.origin_ = origin_;
    if (!edit.whole) next.vertex_pages_ = vertex_pages_, next.triangle_pages_ = triangle_pages_;
    next.vertex_pages_.resize(pages_for(mesh.positions.size(), VertexPage::kSize));
    next.triangle_pages_.resize(pages_for(mesh.triangles.size(), TrianglePage::kSize));
    const std::size_t bytes =
        next.vertex_pages_.size() * sizeof(VertexPage) + next.triangle_pages_.size() * kTrianglePageBytes;
    const auto memory = edit.whole && bytes >= kSharedFrom
                            ? PageMemory::make(next.vertex_pages_.size(), next.triangle_pages_.size())
                            : nullptr;
    next.memory_ = edit.whole ? memory : memory_;
    const mesh::SlotRange everything{0, std::max(mesh.positions.size(), mesh.triangles.size())};
    const std::span whole(&everything, 1);
    const auto vertices =
        touched(edit.whole ? whole : std::span(edit.vertices), VertexPage::kSize, next.vertex_pages_.size());
    const auto triangles =
        touched(edit.whole ? whole : std::span(edit.triangles), TrianglePage::kSize, next.triangle_pages_.size());
    if (!edit.whole && memory_ && lies_apart(next, vertices.size() + triangles.size())) {
        mesh::SurfaceEdit all;
        all.whole = true;
        return edited(mesh, all);
    }
    const bool has_normals = mesh.normals.size() == mesh.positions.size();
    const LargeArray<glm::vec3> computed = has_normals ? LargeArray<glm::vec3>() : normals_of(mesh);
    const Source source{mesh, has_normals ? mesh.normals : computed, origin_};
    tbb::parallel_for(std::size_t{0}, vertices.size() + triangles.size(), [&](std::size_t i) {
        if (i < vertices.size())
            next.vertex_pages_[vertices[i]] = make_vertex_page(source, vertices[i], memory);
        else
            next.triangle_pages_[triangles[i - vertices.size()]] =
                make_triangle_page(source, triangles[i - vertices.size()], memory);
    });
    if (memory) memory->vertices->release_resident(), memory->triangles->release_resident();
    next.summarise();
    return next;
}

void PagedMesh::summarise() {
    for (const auto& page : triangle_pages_) {
        triangle_count_ += page->count;
        for (const TrianglePage::Run& run : page->runs) branch_count_ = std::max(branch_count_, run.branch + 1);
        for (const auto& pair : page->borders) branch_count_ = std::max(branch_count_, pair[1] + 1);
        if (page->count == 0) continue;
        bounds_.include(origin_ + glm::dvec3(page->lower));
        bounds_.include(origin_ + glm::dvec3(page->upper));
    }
}

std::size_t PagedMesh::bytes_beside(const PagedMesh& other) const {
    const auto others = [](const auto& pages, const auto& those) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < pages.size(); ++i) count += i >= those.size() || pages[i] != those[i] ? 1 : 0;
        return count;
    };
    return others(vertex_pages_, other.vertex_pages_) * sizeof(VertexPage) +
           others(triangle_pages_, other.triangle_pages_) * kTrianglePageBytes +
           others(value_pages_, other.value_pages_) * sizeof(ValuePage);
}

PagedMesh PagedMesh::with_values(std::span<const float> values) const {
    PagedMesh valued = *this;
    valued.value_pages_.assign(vertex_pages_.size(), nullptr);
    tbb::parallel_for(std::size_t{0}, vertex_pages_.size(), [&](std::size_t page) {
        const auto made = std::make_shared_for_overwrite<ValuePage>();
        const auto of_page = values.subspan(std::min(values.size(), page * VertexPage::kSize));
        const std::size_t count = std::min(VertexPage::kSize, of_page.size());
        std::copy_n(of_page.begin(), count, made->values.begin());
        std::fill(made->values.begin() + static_cast<std::ptrdiff_t>(count), made->values.end(), kNotKnown);
        valued.value_pages_[page] = made;
    });
    return valued;
}

std::vector<std::uint32_t> PagedMesh::used_vertices() const {
    std::vector<std::uint8_t> used(vertex_pages_.size() * VertexPage::kSize, 0);
    for (const auto& page : triangle_pages_)
        for (std::uint32_t i = 0; i < page->count; ++i)
            for (int corner = 0; corner < 3; ++corner) used[page->triangles[i][corner]] = 1;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < used.size(); ++i)
        if (used[i] != 0) numbers.push_back(i);
    return numbers;
}

std::vector<glm::vec3> PagedMesh::positions(const std::function<bool(int)>& wanted) const {
    std::vector<bool> taken(vertex_pages_.size() * VertexPage::kSize, false);
    std::vector<glm::vec3> found;
    for (const auto& page : triangle_pages_) {
        for (std::uint32_t i = 0; i < page->count; ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t v = page->triangles[i][corner];
                if (taken[v]) continue;
                taken[v] = true;
                if (!wanted || wanted(vertex(v).branch)) found.push_back(position(v));
            }
        }
    }
    return found;
}

// Examines pages in order of their possible reach, until no remaining page can reach farther.
std::vector<glm::vec3> PagedMesh::farthest(std::span<const glm::dvec3> directions,
                                           const std::function<bool(int)>& wanted) const {
    const auto accepts = [&](int branch) { return !wanted || wanted(branch); };
    const auto in_mm = [&](const glm::vec3& corner) { return glm::dvec3(glm::vec3(origin_ + glm::dvec3(corner))); };
    std::vector<const TrianglePage*> pages;
    for (const auto& page : triangle_pages_) {
        const bool any_run = std::ranges::any_of(page->runs, [&](const auto& run) { return accepts(run.branch); });
        if (any_run ||
            std::ranges::any_of(page->borders, [&](const auto& b) { return accepts(b[0]) || accepts(b[1]); }))
            pages.push_back(page.get());
    }
    std::vector<glm::vec3> found;
    std::vector<std::pair<double, const TrianglePage*>> reaches(pages.size());
    for (const glm::dvec3& direction : directions) {
        std::ranges::transform(pages, reaches.begin(), [&](const TrianglePage* page) {
            const glm::bvec3 up = glm::greaterThan(direction, glm::dvec3(0.0));
            return std::pair(glm::dot(glm::mix(in_mm(page->lower), in_mm(page->upper), up), direction), page);
        });
        std::ranges::make_heap(reaches);
        double most = std::numeric_limits<double>::lowest();
        std::optional<glm::vec3> at;
        for (auto end = reaches.end(); end != reaches.begin() && reaches.front().first >= most; --end) {
            const TrianglePage& page = *reaches.front().second;
            std::ranges::pop_heap(reaches.begin(), end);
            for (std::uint32_t i = 0; i < page.count; ++i)
                for (int corner = 0; corner < 3; ++corner) {
                    const std::uint32_t v = page.triangles[i][corner];
                    const glm::vec3 place = position(v);
                    const double reach = glm::dot(glm::dvec3(place), direction);
                    if (reach > most && accepts(vertex(v).branch)) most = reach, at = place;
                }
        }
        if (at) found.push_back(*at);
    }
    return found;
}

std::shared_ptr<const PagedMesh> shared(PagedMesh mesh) {
    constexpr std::uint64_t kLarge = 2'000'000; // triangles
    const auto give_back = [](const PagedMesh* whole) {
        const auto release = [whole] { const std::unique_ptr<const PagedMesh> last(whole); };
        if (whole->triangle_count() < kLarge)
            release();
        else
            free_in_background(release);
    };
    return {new PagedMesh(std::move(mesh)), give_back};
}

} // namespace ramus::render
