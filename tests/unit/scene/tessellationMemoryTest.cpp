#include "core/scene/tessellationMemory.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/scene/availableMemory.h"
#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

/// A folder that stands for /.
class AvailableMemoryTest : public testing::Test {
  protected:
    AvailableMemoryTest() : _root(testing::TempDir() + "availableMemoryTest") {
        std::filesystem::create_directories(_root + "/proc");
        std::filesystem::create_directories(_root + "/sys/fs/cgroup");
    }
    ~AvailableMemoryTest() override { std::filesystem::remove_all(_root); }

    void Write(const std::string& file, const std::string& text) const {
        std::ofstream(_root + file) << text;
    }

    const std::string _root;
};

TEST_F(AvailableMemoryTest, IsWhatTheMachineAndTheControlGroupLeave) {
    EXPECT_EQ(AvailableMemory(_root), SIZE_MAX);
    Write("/proc/meminfo", "MemTotal: 9000 kB\nMemFree: 100 kB\nMemAvailable:    4000 kB\n");
    EXPECT_EQ(AvailableMemory(_root), 4000u * 1024);
    Write("/sys/fs/cgroup/memory.max", "max\n");
    Write("/sys/fs/cgroup/memory.current", "700000\n");
    EXPECT_EQ(AvailableMemory(_root), 4000u * 1024) << "the group has no limit";
    Write("/sys/fs/cgroup/memory.max", "1000000\n");
    EXPECT_EQ(AvailableMemory(_root), 300000u);
    Write("/sys/fs/cgroup/memory.stat", "anon 500000\ninactive_file 200000\n");
    EXPECT_EQ(AvailableMemory(_root), 500000u) << "files can be dropped";
    Write("/sys/fs/cgroup/memory.current", "2000000\n");
    EXPECT_EQ(AvailableMemory(_root), 0u);
}

TEST(AvailableMemory, IsKnownHere) {
    EXPECT_GT(AvailableMemory(), size_t(1) << 20);
    EXPECT_LT(AvailableMemory(), SIZE_MAX);
}

/// So many faces that level 8 does not fit: each takes more than a megabyte there.
Cage CageThatDoesNotFit() {
    const double faces = 1.2 * static_cast<double>(AvailableMemory()) / (1 << 20);
    const int side = static_cast<int>(std::sqrt(faces)) + 3;
    return Torus(side, side);
}

TEST(TessellationMemory, WhatDoesNotFitIsRefusedAndPacketsTrace) {
    Scene scene;
    const Mesh* mesh = AddCage(&scene, "/mesh", CageThatDoesNotFit());
    EXPECT_TRUE(scene.Build({"geometry"}, 0).empty());
    EXPECT_TRUE(scene.TessellationFits());
    EXPECT_GT(mesh->BuiltSurface()->TessellationBytes(), 0u);

    const std::vector<std::string> lines = scene.Build({"geometry"}, 8);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("not tessellated at level 8"), std::string::npos) << lines[0];
    EXPECT_NE(lines[0].find(" GB of memory"), std::string::npos) << lines[0];
    EXPECT_FALSE(scene.TessellationFits());
    EXPECT_EQ(mesh->BuiltSurface()->TessellationBytes(), 0u) << "that of level 0 is given back";
    EXPECT_TRUE(scene.Build({"geometry"}, 8).empty()) << "said once";

    RenderOptions options;
    options.tracer = TracerKind::Tessellated;
    options.level = 8;
    options.samples = 1;
    Film film(8, 8, {});
    RenderStatistics statistics;
    EXPECT_TRUE(RenderFrame(&scene, CameraAt(50), options, &film, &statistics, nullptr, nullptr));
    EXPECT_GT(statistics.primaryRays, 0u);
    EXPECT_EQ(mesh->BuiltSurface()->TessellationBytes(), 0u);

    EXPECT_TRUE(scene.Build({"geometry"}, 1).empty());
    EXPECT_TRUE(scene.TessellationFits());
    EXPECT_EQ(scene.Build({"geometry"}, 8).size(), 1u);
    EXPECT_TRUE(scene.Build({"geometry"}).empty());
    EXPECT_TRUE(scene.TessellationFits());
}

}  // namespace
}  // namespace cc::test
