#include "app/picture/other_session.h"

#include "app/assets/assets.h"
#include "app/assets/territories.h"

#include <utility>

namespace ramus::app {

render::Frame compose_plan(const Session& session, const Assets& assets, std::shared_ptr<const render::PagedMesh> mesh,
                           Viewing viewing, std::size_t plan) {
    Session other = session;
    use_plan(other.marks, plan);
    Assets its = assets; // cheap: what is large is shared
    its.organ.plan = plan;
    if (other.marks.organ.territories == TerritoriesOf::kRemnant) its.organ.territories = assets.organ.compared;
    if (assets.plan) {
        Plan cut = *assets.plan;
        cut.of.cuts = other.marks.cuts;
        cut.cuts = measure::cut_report(*assets.tree, assets.facts->dependency, assets.facts->dependents,
                                       other.marks.cuts, other.marks.planning.reconstruct_mm);
        its.plan = std::make_shared<const Plan>(std::move(cut));
    }
    viewing.objects.reset(); // a change that is tried is of the current plan
    return compose(other, its, std::move(mesh), viewing);
}

Result<render::Frame> compose_as(const Session& session, const Document& document, Assets assets,
                                 std::shared_ptr<const render::PagedMesh> mesh, const Viewing& viewing, Job& job) {
    Document other;
    other.open(document.tree(), session, document.facts());
    refresh(assets, other);
    if (auto read = complete(assets, other, job); !read) return tl::unexpected(read.error());
    return compose(other.session(), assets, std::move(mesh), viewing);
}

} // namespace ramus::app
