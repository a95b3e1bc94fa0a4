#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/trace/bezierRows.h"
#include "core/trace/gridFrame.h"
#include "core/trace/gridStitch.h"
#include "core/trace/levelMetric.h"
#include "core/trace/limitGrid.h"
#include "core/trace/patchSquare.h"
#include "core/trace/rayPacket.h"
#include "core/trace/surface.h"

namespace cc {

/// A part of a patch, and its limit grid as far as rays have reached it.
struct EvaluatedGrid {
    const Surface* surface = nullptr;
    uint32_t patch = 0;
    Square square{0, 0, 0};
    bool isTransposed = false;  ///< columns run along v
    float tolerance = 0;        ///< how far apart neighbours may have points that they share
    uint64_t missingRows = 0;   ///< a bit for each row of points that is not evaluated yet
    BezierRows bezier;          ///< what missing rows are evaluated from
    PatchLevels levels;         ///< of the patch, that the grid was made for
    GridStitch stitch;          ///< that its points were moved by
    GridFrame frame;
    LimitGrid points;
};

/// The levels of a patch of an instance.
struct HeldLevels {
    uint32_t instance, patch;
    bool isRemote;  ///< for rays that start elsewhere
    PatchLevels levels;
};

/// The limit grids that the rays of a batch share: a few of those that were evaluated last. They
/// take the same memory however large the scene is, and die with the batch. One a thread; surfaces
/// must not change meanwhile.
class SharedGrids {
  public:
    SharedGrids()
        : _grids(std::make_unique<EvaluatedGrid[]>(kCount)),
          _levels(std::make_unique<HeldLevels[]>(kLevelCount)) {
        Clear();
    }

    /// The place of a grid. If it holds another grid, or none, whoever asks fills it.
    EvaluatedGrid& At(const Surface& surface, uint32_t patch, const Square& square) {
        const auto part = static_cast<uint32_t>(square.u * 256 + square.v * 65536);
        const uint32_t whole = patch ^ (surface.Number() * 0xc2b2ae35u);
        return _grids[(whole * 0x9e3779b1u + part * 0x85ebca6bu) >> (32 - kBits)];
    }

    /// The place of a patch's levels. If it holds another's, whoever asks fills it.
    HeldLevels& LevelsAt(uint32_t instance, uint32_t patch) {
        return _levels[(patch * 0x9e3779b1u + instance * 0x85ebca6bu) >> (32 - kLevelBits)];
    }

    /// Ends a batch: what follows may trace other surfaces, or the same at another level.
    void Clear() {
        for (int i = 0; i < kCount; ++i) {
            _grids[i].surface = nullptr;
        }
        for (int i = 0; i < kLevelCount; ++i) {
            _levels[i].instance = kNoHit;
        }
    }

    static bool Holds(const EvaluatedGrid& grid, const Surface& surface, uint32_t patch,
                      const Square& square) {
        return grid.patch == patch && grid.surface == &surface && grid.square.u == square.u &&
               grid.square.v == square.v && grid.square.size == square.size;
    }

  private:
    static constexpr int kBits = 7, kCount = 1 << kBits;
    static constexpr int kLevelBits = 10, kLevelCount = 1 << kLevelBits;
    std::unique_ptr<EvaluatedGrid[]> _grids;
    std::unique_ptr<HeldLevels[]> _levels;
};

}  // namespace cc
