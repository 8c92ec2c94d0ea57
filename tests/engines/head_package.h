#pragma once
// A scene's head in an engine's package: exported, drawn by the engine or in its place, and held against
// Dermis' own picture. Pictures are 48 x 48.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/run_program.h"
#include "dermis/image/image.h"
#include "mesh/mesh_files.h"
#include "support/temporary_directory.h"

namespace dermis::head_package {

/// A picture of the page, and the one without scattering that it is compared with.
struct Picture {
    std::string name, query, lambert = "";
};

/// Pictures at rest and at a moment of a clip; mistake: then, with bakes that do not turn with the surface.
struct Motion {
    Image rest, rest_lambert, moved, moved_lambert, mistake;
};

class HeadPackage : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override;
    // The parameter is an engine, which may be followed by a device: three_webgpu.
    static std::string engine() {
        const std::string both = GetParam();
        return both.substr(0, both.find('_'));
    }
    static std::string device() { return GetParam() == engine() + "_webgpu" ? "webgpu" : "webgl"; }
    ProgramResult shell(const std::string& command) { return run_shell(command, directory_.path.string()); }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    // The exported page, with the script of a test in place of its own.
    void export_head();
    // Linear pictures.
    ProgramResult draw(const std::vector<Picture>& pictures);
    // Several looks in one page: loading a head takes most of its time. Each gets a picture of its name.
    void draw_looks(const std::vector<std::string>& looks);
    // Square `number` of `count` that a page drew one below the other.
    static Image square(const Image& all, int number, int count);
    // The captured share against `surface` of each row.
    std::map<std::string, double> shares(const std::vector<Picture>& pictures);

    // Linear, as draw() samples it.
    Image rendered(const std::string& settings);
    Image read(const std::string& name);

    /// The drawn pictures lambert, scattering, gain, and with a mistake normals, curvature, srgb and these:
    /// the error of scattering's effect, over the effect of preintegrated.
    void expect_effect(double most_error, const std::vector<std::string>& mistakes = {});

    /// A page draws several pictures: loading a head takes most of its time.
    Motion draw_motion(const std::string& clip, const std::string& time_s);

    /// Of a package, in its settings: nothing is known of the curvature of its targets.
    void forget_curvature_of_targets();

    /// What the package's curvature changes in the picture of a moment, against what it changes in Dermis.
    void expect_curvature_follows(const Image& followed, const Image& kept, const std::string& moment);

    /// Against Dermis with what was baked at rest: the errors of scattering's effect, and Lambert's motion.
    void expect_motion(const Motion& drawn, const std::string& moment, double most_error);

    // Turned in the scene: what is baked is in another space than the vertices of the file.
    void use_turned_bust();
    // A face with joints, targets, eyes and teeth; the camera does not follow it.
    static std::filesystem::path face() { return test::asset("ict_face/ict_moving.glb"); }
    void use_face();

    TemporaryDirectory directory_;
    std::string scene_ = "bust";
};

/// Names of instances.
inline constexpr auto kName = [](const auto& one) { return std::string(one.param); };
inline const std::string kPreintegrated = "--technique preintegrated --set gain=";

/// Root of the sum of squares.
double distance(const Image& a, const Image& b);

/// a - b.
Image change(const Image& a, const Image& b);

}  // namespace dermis::head_package
