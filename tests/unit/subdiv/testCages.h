#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/subdiv/controlMesh.h"

namespace cc::test {

/// A control cage with its points and a name for failure messages.
struct Cage {
    std::string name;
    ControlMesh mesh;
    std::vector<Vec3f> points;
};

Cage Cube();
/// n x n quads in the xy plane with bumps, open on all sides.
Cage Sheet(int n);
/// A torus of quads: regular everywhere.
Cage Torus(int around, int across);
Cage Tetrahedron();
/// A fan of quads around one vertex of the given valence, then one more ring of quads.
Cage Fan(int valence);
/// A drum whose lids are n-gons.
Cage Drum(int sides);

// Under the Loop scheme:

/// A sheet of quads, each cut in two: regular inside.
Cage TriangleSheet(int n);
/// A torus of triangles: regular everywhere.
Cage TriangleTorus(int around, int across);
/// Triangles around one vertex of the given valence, then one more ring of them.
Cage TriangleFan(int valence);
/// Triangles around a vertex on the boundary.
Cage OpenTriangleFan(int faceCount);
Cage LoopOctahedron();
Cage LoopIcosahedron();

/// How GoogleTest shows a cage, and names a test of one.
void PrintTo(const Cage& cage, std::ostream* out);
std::string TestName(const testing::TestParamInfo<Cage>& info);

/// Every kind of cage there is, by theme (cageKit.h): all of the above, and what tags, boundaries
/// and odd topology make of them.
std::vector<Cage> Catalogue();

/// Cages on which Bfr contradicts Far, each with the reason.
std::vector<Cage> KnownDifferences();

/// Both, for tests that do not need Bfr.
std::vector<Cage> AllCages();

}  // namespace cc::test
