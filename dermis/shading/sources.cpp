// Files in the order in which they include each other.

#include <algorithm>

#include "dermis/shading/parser.h"
#include "dermis/shading/shading.h"

namespace dermis::shading {
namespace {

enum class Visit { none, open, done };

class Order {
  public:
    explicit Order(std::vector<Unit>& units) : units_(units), visits_(units.size(), Visit::none) {}

    Result<std::vector<Unit>> run() {
        for (size_t i = 0; i < units_.size(); ++i) DERMIS_TRY(visit(i));
        return std::move(ordered_);
    }

  private:
    Result<void> visit(size_t index) {
        if (visits_[index] == Visit::done) return {};
        if (visits_[index] == Visit::open)
            return Error{units_[index].path +
                         ": includes itself through another file; move what both need to a third"};
        visits_[index] = Visit::open;
        for (const std::string& include : units_[index].includes) {
            const auto found = std::ranges::find(units_, include, &Unit::path);
            if (found == units_.end())
                return Error{units_[index].path + ": includes " + include +
                             ", which is none of the shading functions' files; move what it needs there"};
            DERMIS_TRY(visit(size_t(found - units_.begin())));
        }
        visits_[index] = Visit::done;
        ordered_.push_back(units_[index]);
        return {};
    }

    std::vector<Unit>& units_;
    std::vector<Visit> visits_;
    std::vector<Unit> ordered_;
};

}  // namespace

Result<std::vector<Unit>> read_sources(std::span<const Source> sources) {
    std::vector<Unit> units;
    for (const Source& source : sources) {
        DERMIS_TRY_ASSIGN(Unit unit, parse(source.path, source.text));
        units.push_back(std::move(unit));
    }
    DERMIS_TRY_ASSIGN(std::vector<Unit> ordered, Order(units).run());
    DERMIS_TRY(check(ordered));
    return ordered;
}

}  // namespace dermis::shading
