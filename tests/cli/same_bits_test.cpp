// Compares the results of one edit for several instruction sets and numbers of threads.
#include <cmath>

#include "cli/command_line.h"
#include "support/largest_distance.h"

namespace lapwing {
namespace {

// The tolerance, as a fraction of the diagonal. AVX2, AVX-512 and fused operations in the C library
// round differently, and settling ends when no vertex would move by more than 1e-4 edge lengths.
constexpr double kSettled = 1e-5;

class SameBits : public CommandLine {
 protected:
  void SetUp() override {
    write_mesh(rippled_cylinder(40, 81), file("tube.ply"));
    write_mesh(bumpy_plane(24, 6, 0.03), file("bumps.ply"));
    write_mesh(icosphere(3), file("ball.ply"));
    write("bend.json", recipe(kBend));
    write("all.json", recipe(std::string(kBend) + "," + kCoat + "," + kTransplant));
  }

  // Returns the result of the recipe `name` when the program has these environment variables.
  Mesh made(const std::string& name, const std::string& environment) const {
    succeed("run " + name + " --device cpu --quiet --save out.ply", environment);
    return read_mesh(file("out.ply"));
  }
  void expect_same(const std::string& environment, const std::string& other) const {
    const Mesh a = made("all.json", environment);
    const Mesh b = made("all.json", other);
    EXPECT_TRUE(a.positions == b.positions) << environment << ", " << other;
    EXPECT_TRUE(a.face_vertices() == b.face_vertices()) << environment << ", " << other;
  }

  static std::string recipe(const std::string& steps) {
    return R"({"lapwing": 1, "mesh": "tube.ply", "steps": [)" + steps + "]}";
  }
  static constexpr const char* kBend = R"({"op": "deform", "roi": {"all": true},
     "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.5]}},
     "handles": [{"region": {"box": {"min": [-1, -1, 5.5], "max": [1, 1, 7]}},
                  "move": {"rotate": {"axis": [1, 0, 0], "degrees": 70},
                           "translate": [0.3, 1.5, -1.0]}}]})";
  static constexpr const char* kCoat = R"({"op": "coat", "source": "bumps.ply",
     "source_patch": {"all": true}, "target_patch": {"disk": {"center": 1000, "radius": 0.6}},
     "detail_size": 0.3})";
  static constexpr const char* kTransplant = R"({"op": "transplant", "part": {"mesh": "ball.ply",
       "region": {"box": {"min": [-2, -2, 0], "max": [2, 2, 2]}}},
     "target_region": {"disk": {"center": 1900, "radius": 0.3}}})";
};

TEST_F(SameBits, WithAnyNumberOfThreads) {
  for (const char* threads : {"2", "5", "8"}) {
    expect_same("LAPWING_THREADS=1", std::string("LAPWING_THREADS=") + threads);
  }
}

// The triangles that remeshing and bridging create do not depend on rounding errors.
TEST_F(SameBits, WithOtherInstructionsTheSameTriangles) {
  const Mesh baseline = made("all.json", "LAPWING_INSTRUCTION_SET=baseline");
  for (const char* environment : {"", "LAPWING_INSTRUCTION_SET=avx2"}) {
    const Mesh other = made("all.json", environment);
    EXPECT_TRUE(other.face_vertices() == baseline.face_vertices()) << environment;
  }
}

TEST_F(SameBits, OrNearlySoWithOtherInstructionsAndWithAnOlderLibrary) {
  const Mesh baseline = made("bend.json", "LAPWING_INSTRUCTION_SET=baseline");
  for (const char* environment :
       {"", "LAPWING_INSTRUCTION_SET=avx2",
        "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,-FMA,-FMA_Usable,-AVX512F"}) {
    const Mesh other = made("bend.json", environment);
    EXPECT_LT(test::largest_distance(other.positions, baseline.positions),
              kSettled * bounds_of(baseline.positions).diagonal())
        << environment;
  }
}

}  // namespace
}  // namespace lapwing
