#pragma once
// Rows of the column: a dim label on the left, the widget on the right, a tooltip over both. Only for .cpp
// files of panels.

#include <array>
#include <string>
#include <vector>

#include "dermis/base/parameter.h"
#include "dermis/view/panels.h"

namespace dermis::view {

struct NumberRow {
    std::string name;  ///< of the widget, and its label (label_of)
    std::string unit, doc;
    double min = 0, max = 1, default_value = 0;
    bool whole = false;
};

class Rows {
  public:
    /// `prefix` keeps names of one part of the column apart from another's: "light.", and none for
    /// parameters.
    explicit Rows(WidgetMap& widgets, std::string prefix = "")
        : widgets_(&widgets), prefix_(std::move(prefix)) {}

    /// Each returns true when the user changed the value. Right click: the default.
    bool number(const NumberRow& row, float& value);
    bool color(const NumberRow& row, Vec3& value);
    bool toggle(const NumberRow& row, bool& value);
    bool choice(const NumberRow& row, const std::vector<std::string>& names, int& index);
    /// Any parameter, as its table has it.
    bool parameter(const Parameter& parameter, ParameterValues& values);

  private:
    void begin(const NumberRow& row, bool changed_from_default);
    bool end(const NumberRow& row);

    [[nodiscard]] std::string id(const NumberRow& row) const { return "##" + prefix_ + row.name; }

    WidgetMap* widgets_;
    std::string prefix_;
};

/// A heading that folds; true while open. Its widget is "section.TITLE".
[[nodiscard]] bool section(const char* title, bool open_at_first, WidgetMap& widgets);

/// The region of the last widget gets this name.
void name_widget(WidgetMap& widgets, const std::string& name);

/// Window flags for fixed windows: no frame, no moving, no saved state.
[[nodiscard]] int fixed_window();

/// Index of `name` in `names`, or -1.
[[nodiscard]] int index_of(const std::vector<std::string>& names, const std::string& name);

/// The label of a name: "shadow width" for "shadow_width_mm".
[[nodiscard]] std::string label_of(const std::string& name);

}  // namespace dermis::view
