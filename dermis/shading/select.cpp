#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "dermis/base/text.h"
#include "dermis/shading/shading.h"

namespace dermis::shading {
namespace {

void names_in(const Expression& e, std::set<std::string>& names) {
    if (e.kind == Expression::Kind::name || e.kind == Expression::Kind::call) names.insert(e.text);
    for (const Expression& child : e.children) names_in(child, names);
}

void names_in(const std::vector<Statement>& body, std::set<std::string>& names) {
    for (const Statement& s : body) {
        for (const Declarator& declarator : s.declarators)
            if (declarator.value) names_in(*declarator.value, names);
        for (const Expression& e : s.expressions) names_in(e, names);
        names_in(s.body, names);
        names_in(s.otherwise, names);
    }
}

// The names that an item declares: a function, or the constants of a line.
std::vector<std::string> declared_by(const Item& item) {
    if (!item.name.empty()) return {item.name};
    std::vector<std::string> names;
    for (const Statement& s : item.constants)
        for (const Declarator& constant : s.declarators) names.push_back(constant.name);
    return names;
}

using Items = std::map<std::string, const Item*, std::less<>>;

Items items_of(std::span<const Unit> units) {
    Items items;
    for (const Unit& unit : units)
        for (const Item& item : unit.items)
            for (std::string& name : declared_by(item)) items.emplace(std::move(name), &item);
    return items;
}

void reach(const std::string& name, const Items& items, std::set<const Item*>& kept) {
    const auto found = items.find(name);
    if (found == items.end() || !kept.insert(found->second).second) return;
    std::set<std::string> names;
    names_in(found->second->body, names);
    names_in(found->second->constants, names);
    for (const std::string& used : names) reach(used, items, kept);
}

}  // namespace

Result<void> keep_functions(std::vector<Unit>& units, std::span<const std::string> names) {
    const Items items = items_of(units);
    std::set<const Item*> kept;
    for (const std::string& name : names) {
        if (const auto found = items.find(name); found == items.end() || found->second->name.empty()) {
            std::vector<std::string> known;
            for (const auto& [other, item] : items)
                if (!item->name.empty()) known.push_back(other);
            return Error{unknown_name("function", name, known)};
        }
        reach(name, items, kept);
    }
    for (Unit& unit : units)
        std::erase_if(unit.items, [&](const Item& item) { return !kept.contains(&item); });
    std::erase_if(units, [](const Unit& unit) { return unit.items.empty(); });
    return {};
}

}  // namespace dermis::shading
