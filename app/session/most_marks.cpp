#include "app/session/most_marks.h"

#include "app/session/numbers.h"

#include <tuple>

namespace ramus::app {

Result<void> check_counts(const Marks& marks) {
    for (const auto& [count, most, name] : {std::tuple(marks.lesions.size(), kMostMarks, "lesions"),
                                            {marks.lesion_meshes.size(), kMostShapes, "lesion meshes"},
                                            {marks.context.size(), kMostShapes, "context shapes"},
                                            {marks.cuts.size(), kMostMarks, "cuts"},
                                            {marks.measurements.size(), kMostMarks, "measurements"},
                                            {marks.edits.size(), kMostEdits, "edits"}})
        if (count > most)
            return fail(grouped(count) + " " + name + ", where there can be " + grouped(most), {},
                        "remove those that are not needed");
    return {};
}

} // namespace ramus::app
