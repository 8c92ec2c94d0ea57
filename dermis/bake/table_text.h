#pragma once
// Internal to table_io: the two formats that are text.

#include <string>
#include <string_view>

#include "dermis/bake/table.h"

namespace dermis::inline bake {

/// Header "U,V,r,g,b" (or "U,V,value"), zonal tables "U,order,r,g,b".
[[nodiscard]] std::string table_csv(const Table& table);

/// `convention` says size and meaning. Errors name `place` and the line: a wrong header, a cell that is not a
/// number, too few or too many rows, coordinates that are not the convention's.
[[nodiscard]] Result<Table> parse_table_csv(std::string_view text, const ParsedConvention& convention,
                                            std::string_view place);

/// `name` is the stem of the file; anything that is not a letter or digit becomes '_'.
[[nodiscard]] std::string table_c_header(const Table& table, std::string_view name);

}  // namespace dermis::inline bake
