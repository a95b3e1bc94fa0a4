#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

/// What a step does to a cage under construction.
enum class CageChange {
    // Topology that stays a manifold, or mostly.
    AddTriangle,  ///< on an edge
    AddQuad,
    AddPolygon,
    FillNotch,  ///< a face between two edges of the boundary
    FillHole,   ///< a face over a loop of the boundary
    SplitFace,  ///< into triangles about a new point
    SplitEdge,  ///< by a point that has valence 2
    RemoveFace,
    AddPiece,  ///< another shape, apart, at a vertex or on an edge
    // Topology that nobody should write.
    JoinPoints,    ///< a face over points that may have nothing to do with each other
    MergePoints,   ///< two become one
    RepeatFace,    ///< the same way round or the other
    CollapseEdge,  ///< of one face only
    AddPoint,      ///< that no face uses
    // Tags.
    Crease,  ///< a run of edges
    Corner,
    Hole,
};

/// A change to a cage under construction. What it acts on is told by numbers that count modulo
/// whatever is there; so any list of steps makes a cage, with steps left out too.
struct CageStep {
    CageChange change;
    int a, b, c;
    float sharpness;
};

/// All it takes to build a cage. The simplest is a single quad.
struct CageRecipe {
    int shape, size;  ///< what to begin with
    BoundaryRule boundaryRule;
    CreaseRule creaseRule;
    TriangleRule triangleRule;
    bool leftHanded;
    bool sharpnessByEdge;  ///< else one a crease
    std::vector<CageStep> steps;
};

Cage BuildCage(const CageRecipe& recipe);

/// A cage as C++ that builds it with the functions of cageKit.h, for failure messages and for the
/// catalogue.
std::string ToCode(const Cage& cage);

/// Fails the test, with the smallest cage found, unless a property of generated cages holds: it
/// returns why it does not, or nothing. The cages are the same in every run; RapidCheck's RC_PARAMS
/// asks for others, or more.
void ExpectForGeneratedCages(const std::string& description,
                             const std::function<std::string(const Cage&)>& property);

}  // namespace cc::test
