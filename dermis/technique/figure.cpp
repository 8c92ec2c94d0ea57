#include "dermis/technique/figure.h"

#include <set>

namespace dermis::inline technique {
namespace {

std::vector<std::string> cell_problems(const FigureCell& cell, const std::set<std::string>& known) {
    std::vector<std::string> found;
    if (cell.label.empty()) found.push_back("has no label");
    for (const std::string& id : {cell.subject, cell.compare_to})
        if (!id.empty() && !known.contains(id))
            found.push_back("names '" + id + "', which no cell before it is");
    if (cell.kind == CellKind::table && cell.table.empty()) found.push_back("does not name its table");
    if (cell.kind == CellKind::computed && !cell.compute) found.push_back("has nothing to compute");
    if (cell.kind == CellKind::difference && (cell.subject.empty() || cell.compare_to.empty()))
        found.push_back("is a difference and needs subject and compare_to");
    if (known.contains(cell.id)) found.push_back("has the id of an earlier cell");
    return found;
}

}  // namespace

std::vector<std::string> problems(const Figure& figure) {
    std::vector<std::string> all;
    std::set<std::string> known;
    for (const auto& [what, text] :
         {std::pair{"id", figure.id}, {"title", figure.title}, {"source", figure.source}})
        if (text.empty()) all.push_back("figure '" + figure.id + "' has no " + what);
    if (figure.rows.empty()) all.push_back("figure '" + figure.id + "' has no cells");
    for (const FigureRow& row : figure.rows)
        for (const FigureCell& cell : row.cells) {
            for (const std::string& problem : cell_problems(cell, known))
                all.push_back("figure '" + figure.id + "', cell '" + cell.label + "' " + problem);
            if (!cell.id.empty()) known.insert(cell.id);
        }
    return all;
}

}  // namespace dermis::inline technique
