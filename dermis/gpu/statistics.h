#pragma once
// Compiler statistics of the pipelines of a pass list, for a chip that need not be installed: Mesa's RADV
// opens a device without hardware, which compiles and draws nothing.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dermis/gpu/device.h"
#include "dermis/gpu/executor.h"

namespace dermis::gpu {

/// Statistics of one shader. Cycles are the compiler's estimate: a loop that it did not unroll
/// counts eight times, a branch half (ACO, aco_statistics.cpp).
struct ShaderStatistics {
    std::string stage;  ///< "vertex", "fragment", "compute"
    uint32_t subgroup_size = 0;
    uint64_t instructions = 0, copies = 0, branches = 0;
    uint64_t vgprs = 0, sgprs = 0, spilled_vgprs = 0, spilled_sgprs = 0;
    uint64_t subgroups_per_simd = 0;
    uint64_t code_bytes = 0, lds_bytes = 0, scratch_bytes = 0;
    uint64_t vmem_clauses = 0, smem_clauses = 0;
    uint64_t latency_cycles = 0;
    /// A SIMD that is full of subgroups is busy so long for each 64 threads.
    uint64_t inverse_throughput_cycles = 0;
};

/// One declaration for tables, JSON and records.
struct StatisticField {
    const char* name;         ///< of the member
    const char* driver_name;  ///< as RADV reports it
    uint64_t ShaderStatistics::*member;
};
[[nodiscard]] std::span<const StatisticField> statistic_fields();

struct PassStatistics {
    std::string pass;
    std::vector<ShaderStatistics> shaders;  ///< empty: a transfer, or a pass that only clears
    std::vector<std::string> textures;      ///< names of the textures that the shaders declare
    uint32_t vertex_bytes = 0;              ///< of the inputs of one vertex
};

/// Whether Mesa's RADV is on this machine, which NullDevice needs.
[[nodiscard]] bool null_driver_installed();

/// Compiles for one chip. Movable; not for several threads at once, nor while another thread opens a device:
/// opening it sets variables of the environment for a moment.
class NullDevice {
  public:
    /// `chip` as RADV_FORCE_FAMILY has it since Mesa 23, "navi21". It must be one of report/model.h: RADV
    /// ends the process at a name that it does not know. Error: no RADV; it says what to install.
    [[nodiscard]] static Result<NullDevice> open(std::string_view chip, ShaderSource shaders);
    ~NullDevice();
    NullDevice(NullDevice&&) noexcept;
    NullDevice& operator=(NullDevice&&) noexcept;

    /// The pipelines that an executor would draw this list with; one entry a pass. `list` has no problems().
    [[nodiscard]] Result<std::vector<PassStatistics>> compile(const PassList& list);
    [[nodiscard]] const DeviceInfo& info() const;

  private:
    struct State;
    explicit NullDevice(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dermis::gpu
