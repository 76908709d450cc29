#include "app/session/most_marks.h"

#include "app/session/numbers.h"

#include <utility>

namespace ramus::app {

Result<void> check_counts(const Marks& marks) {
    for (const auto& [count, name] : {std::pair(marks.lesions.size(), "lesions"),
                                      {marks.lesion_meshes.size(), "lesion meshes"},
                                      {marks.context.size(), "context shapes"},
                                      {marks.cuts.size(), "cuts"},
                                      {marks.measurements.size(), "measurements"}})
        if (count > kMostMarks)
            return fail(grouped(count) + " " + name + ", where there can be " + grouped(kMostMarks), {},
                        "remove those that are not needed");
    return {};
}

} // namespace ramus::app
