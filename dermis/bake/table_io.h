#pragma once
// Tables as files, by extension:
//
//   .exr         half (default) or float             convention embedded
//   .png         16 bit (default) or 8 bit           convention embedded; flagged sRGB if its encoding is
//   .ktx2 .dds   RGBA16F                             convention embedded in KTX2
//   .h           C array of floats, rows in file order
//   .csv         "n_dot_l,curvature_per_mm,r,g,b": one row a texel, decoded values, shortest exact numbers
//
// Beside every file lies FILE.json, the same convention. No mips, no compression of blocks; use clamp-to-edge
// and keep lookups half a texel inside (axis coordinates already are: texels are at their centres).

#include <filesystem>
#include <string>
#include <string_view>

#include "dermis/bake/table.h"

namespace dermis::inline bake {

/// Resolves `automatic` for this extension. Errors: an unknown extension or one that cannot hold `storage`;
/// the message lists what can.
[[nodiscard]] Result<TableStorage> storage_for(const std::filesystem::path& path, TableStorage storage);

/// 8 bits hold a table of light only sRGB-encoded (the first linear step is 0.004); all others hold it
/// linear.
[[nodiscard]] TableEncoding encoding_for(TableKind kind, TableStorage storage);

/// Encodes as the table's convention says, rounds to `storage`, writes file and sidecar whole or not at all.
[[nodiscard]] Result<void> write_table(const std::filesystem::path& path, const Table& table,
                                       TableStorage storage = TableStorage::automatic);

/// The bytes that write_table() writes to this path, without the sidecar.
[[nodiscard]] Result<std::vector<std::byte>> table_bytes(const std::filesystem::path& path,
                                                         const Table& table,
                                                         TableStorage storage = TableStorage::automatic);

/// The table as the file has it, decoded. Refuses: a file without a convention (see `dermis lint`), one whose
/// embedded and sidecar conventions differ, a size that contradicts it, a PNG flagged sRGB whose convention
/// is not, a convention that does not match `use` (the message says which key), a .h file (it is for
/// compilers).
[[nodiscard]] Result<Table> read_table(const std::filesystem::path& path, const TableUse& use);

[[nodiscard]] std::filesystem::path sidecar_path(const std::filesystem::path& path);

/// Whether a PNG's chunks claim sRGB; false for other files.
[[nodiscard]] bool png_is_flagged_srgb(std::span<const std::byte> file);

// Internal to table_io: the two formats that are text.

/// Header "U,V,r,g,b" (or "U,V,value"), zonal tables "U,order,r,g,b".
[[nodiscard]] std::string table_csv(const Table& table);

/// `convention` says size and meaning. Errors name `place` and the line: a wrong header, a cell that is not a
/// number, too few or too many rows, coordinates that are not the convention's.
[[nodiscard]] Result<Table> parse_table_csv(std::string_view text, const ParsedConvention& convention,
                                            std::string_view place);

/// `name` is the stem of the file; anything that is not a letter or digit becomes '_'.
[[nodiscard]] std::string table_c_header(const Table& table, std::string_view name);

}  // namespace dermis::inline bake
