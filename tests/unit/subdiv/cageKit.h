#pragma once

#include <string>
#include <vector>

#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

// What the themes of the catalogue build their cages with.

void AddFace(Cage* cage, const std::vector<int>& vertices);
void AddCrease(Cage* cage, const std::vector<int>& vertices, float sharpness);
void AddCorner(Cage* cage, int vertex, float sharpness);

// A cage with one thing changed and another name.

Cage Named(Cage cage, const std::string& name);
Cage WithScheme(Cage cage, Scheme scheme, const std::string& name);
Cage WithBoundary(Cage cage, BoundaryRule rule, const std::string& name);
Cage WithCrease(Cage cage, const std::vector<int>& vertices, float sharpness,
                const std::string& name);
Cage WithCorner(Cage cage, int vertex, float sharpness, const std::string& name);
Cage WithHoles(Cage cage, const std::vector<int>& holes, const std::string& name);

/// A cage whose points are anywhere near where they were: what a limit is made of shows where
/// nothing is alike.
Cage Rough(Cage cage);

/// A cage under the Loop scheme, with the same points and tags: its faces are cut into triangles,
/// from their first corner on.
Cage Triangulated(const Cage& cage);

/// The faces of Sheet(4) over a roof: ridges along both middle lines show what creases do.
Cage Roof();

/// A cage of these faces over points that lie on no plane.
Cage FromFaces(const std::string& name, const std::vector<std::vector<int>>& faces);
/// A cage of these faces over these points.
Cage FromFaces(const std::string& name, const std::vector<std::vector<int>>& faces,
               const std::vector<Vec3f>& points);

// The catalogue by theme.

std::vector<Cage> ShapeCages();          ///< valences, n-gons, degenerate faces; no tags
std::vector<Cage> BoundaryCages();       ///< the boundary rules, corners of few and many faces
std::vector<Cage> CreaseCages();         ///< one crease at a time, infinite and semi-sharp
std::vector<Cage> CreaseMeetingCages();  ///< creases that end, cross and meet
std::vector<Cage> CornerCages();         ///< sharp vertices
std::vector<Cage> NonManifoldCages();    ///< edges of three faces, bow ties, duplicate faces
std::vector<Cage> CombinedCages();       ///< several features at once, holes among them

std::vector<Cage> LoopShapeCages();  ///< Loop's scheme: valences, fans, closed and open
std::vector<Cage> LoopTagCages();    ///< Loop's scheme: every tag, and several at once

}  // namespace cc::test
