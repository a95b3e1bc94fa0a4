#pragma once

#include <memory>
#include <vector>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"

namespace cc::test {

/// The limit surface by OpenSubdiv: what ours is compared with. It shares nothing with our patches
/// but the meaning of the mesh, and computes in doubles.
class LimitOracle {
  public:
    virtual ~LimitOracle() = default;

    struct Sample {
        bool exists = false;
        Vec3f position;
        /// The primvar that was given with the points.
        Vec3f value;
        /// Unit normal, zero where the derivatives give none.
        Vec3f normal;
        /// How far a derivative must be off to turn the normal by a radian.
        double normalScale = 0;
    };
    virtual Sample Evaluate(const FaceParameter& at) = 0;

    /// True if the surface covers a face.
    virtual bool HasFace(uint32_t face) = 0;
};

/// Refinement steps by which features are isolated. What is left of them is approximated.
constexpr int kOracleLevels = 10;

/// Bfr: evaluates a face from the rings of its corners, as we do. It contradicts Far on a few
/// meshes (KnownDifferences), and release 3.5 writes beyond its memory on some that are no
/// manifold, so it is for cages that we know.
/// @param values  a primvar, one a point
std::unique_ptr<LimitOracle> MakeBfrOracle(const ControlMesh& mesh,
                                           const std::vector<Vec3f>& points,
                                           const std::vector<Vec3f>& values);

/// Far: refines the whole mesh towards its features, topology and all, and evaluates patches of
/// what comes out. Safe on any mesh.
std::unique_ptr<LimitOracle> MakeFarOracle(const ControlMesh& mesh,
                                           const std::vector<Vec3f>& points,
                                           const std::vector<Vec3f>& values,
                                           int levels = kOracleLevels);

/// Fills a sample from a point of the surface and its derivatives, each a position and a primvar.
void SetSample(const double p[6], const double du[6], const double dv[6],
               LimitOracle::Sample* sample);

}  // namespace cc::test
