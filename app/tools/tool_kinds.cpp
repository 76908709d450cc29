#include "app/tools/tool_kinds.h"

#include "app/tools/lasso_tool.h"

#include <algorithm>

namespace ramus::app {

namespace {

template <typename T> std::unique_ptr<Tool> make() { return std::make_unique<T>(); }

} // namespace

const std::vector<ToolKind>& tool_kinds() {
    static const std::vector<ToolKind> kinds{
        {std::string(kNavigate),
         "Navigate",
         "The mouse turns the view and selects branches.",
         {"V"},
         {{{0.28F, 0.12F},
           {0.28F, 0.80F},
           {0.44F, 0.65F},
           {0.56F, 0.90F},
           {0.66F, 0.85F},
           {0.55F, 0.61F},
           {0.76F, 0.59F},
           {0.28F, 0.12F}}},
         nullptr},
        {"lasso",
         "Lasso",
         "Selects what lies inside a line drawn around it.",
         {"W"},
         {{{0.42F, 0.68F},
           {0.22F, 0.62F},
           {0.10F, 0.46F},
           {0.14F, 0.28F},
           {0.34F, 0.15F},
           {0.58F, 0.13F},
           {0.80F, 0.21F},
           {0.90F, 0.37F},
           {0.83F, 0.54F},
           {0.64F, 0.66F},
           {0.42F, 0.68F},
           {0.34F, 0.77F},
           {0.42F, 0.86F},
           {0.36F, 0.95F}}},
         make<LassoTool>},
        {"lasso-polygon",
         "Polygon lasso",
         "Selects what lies inside a polygon, clicked corner by corner.",
         {"Shift+W"},
         {{{0.14F, 0.80F}, {0.22F, 0.22F}, {0.62F, 0.40F}, {0.88F, 0.14F}, {0.84F, 0.82F}, {0.14F, 0.80F}}},
         make<PolygonLassoTool>},
    };
    return kinds;
}

const ToolKind* find_tool(std::string_view name) {
    const auto& kinds = tool_kinds();
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [&](const ToolKind& kind) { return kind.name == name; });
    return found == kinds.end() ? nullptr : &*found;
}

} // namespace ramus::app
