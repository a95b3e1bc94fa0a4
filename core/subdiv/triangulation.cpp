#include "core/subdiv/triangulation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

namespace cc {
namespace {

/// Directions that differ by less, in parts of the polygon's size, count as the same: about what
/// the rounding of its points to floats leaves open.
constexpr double kStraight = 2e-7;

/// Corners looked at for each corner of the polygon before ears are clipped unseen: only polygons
/// that cross themselves everywhere come here.
constexpr int64_t kLooksPerCorner = 20000;

struct Vec2d {
    double x = 0, y = 0;
};

double Cross(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool IsSame(const Vec2d& a, const Vec2d& b) { return a.x == b.x && a.y == b.y; }

/// Positions in a plane in which the polygon runs counterclockwise, scaled into a square of side 1.
std::vector<Vec2d> Project(const std::vector<Vec3f>& corners) {
    double lower[3], upper[3], normal[3] = {};
    for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = upper[axis] = corners[0][axis];
        for (const Vec3f& p : corners) {
            lower[axis] = std::min<double>(lower[axis], p[axis]);
            upper[axis] = std::max<double>(upper[axis], p[axis]);
        }
    }
    const double size =
        std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2], 1e-300});
    const auto at = [&](size_t i, int axis) { return (corners[i][axis] - lower[axis]) / size; };
    for (size_t i = 0, previous = corners.size() - 1; i < corners.size(); previous = i++) {
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            normal[axis] += (at(previous, u) - at(i, u)) * (at(previous, v) + at(i, v));
        }
    }
    // Dropping the normal's largest component keeps insides inside.
    int axis = 0;
    for (int other = 1; other < 3; ++other) {
        axis = std::fabs(normal[other]) > std::fabs(normal[axis]) ? other : axis;
    }
    const bool isFlipped = normal[axis] < 0;
    std::vector<Vec2d> positions(corners.size());
    for (size_t i = 0; i < corners.size(); ++i) {
        const double u = at(i, (axis + 1) % 3), v = at(i, (axis + 2) % 3);
        positions[i] = isFlipped ? Vec2d{v, u} : Vec2d{u, v};
    }
    return positions;
}

/// Corners by where they are, in the cells of a grid over the unit square.
class CornerGrid {
  public:
    explicit CornerGrid(size_t cornerCount)
        : _side(std::max(1, static_cast<int>(std::sqrt(double(cornerCount) / 2)))),
          _cells(static_cast<size_t>(_side) * _side) {}

    void Add(uint32_t corner, const Vec2d& at) {
        _cells[_Cell(at.y) * _side + _Cell(at.x)].push_back(corner);
        ++_count;
    }

    /// Calls visit(corner) for all in the cells that a box meets, until it returns Stop. What it
    /// returns Remove for is gone.
    enum class Then { GoOn, Remove, Stop };
    template <typename Visit>
    void ForEach(const Vec2d& lower, const Vec2d& upper, const Visit& visit) {
        if (_count == 0) {
            return;
        }
        for (size_t y = _Cell(lower.y); y <= _Cell(upper.y); ++y) {
            for (size_t x = _Cell(lower.x); x <= _Cell(upper.x); ++x) {
                std::vector<uint32_t>& cell = _cells[y * _side + x];
                for (size_t i = 0; i < cell.size();) {
                    const Then then = visit(cell[i]);
                    if (then == Then::Stop) {
                        return;
                    }
                    if (then == Then::Remove) {
                        cell[i] = cell.back();
                        cell.pop_back();
                        --_count;
                    } else {
                        ++i;
                    }
                }
            }
        }
    }

  private:
    size_t _Cell(double x) const {
        return static_cast<size_t>(std::min(std::max(x * _side, 0.0), _side - 1.0));
    }

    int _side;
    std::vector<std::vector<uint32_t>> _cells;
    size_t _count = 0;
};

/// How willingly a corner is clipped.
enum class Rank { Ear, Blocked, Straight, Reflex };

class EarClipper {
  public:
    explicit EarClipper(const std::vector<Vec3f>& corners)
        : _corners(corners),
          _at(Project(corners)),
          _next(corners.size()),
          _previous(corners.size()),
          _version(corners.size(), 0),
          _isLeft(corners.size(), 1),
          _isInGrid(corners.size(), 0),
          _grid(corners.size()),
          _left(corners.size()),
          _looksLeft(kLooksPerCorner * static_cast<int64_t>(corners.size())) {
        const auto count = static_cast<uint32_t>(corners.size());
        for (uint32_t i = 0; i < count; ++i) {
            _next[i] = (i + 1) % count;
            _previous[i] = (i + count - 1) % count;
        }
        for (uint32_t i = 0; i < count; ++i) {
            _NoteReflex(i);
        }
        for (uint32_t i = 0; i < count; ++i) {
            _Push(i);
        }
    }

    std::vector<PolygonTriangle> Clip() {
        std::vector<PolygonTriangle> triangles;
        triangles.reserve(_corners.size() - 2);
        while (_left > 3) {
            const Candidate best = _TakeBest();
            if (best.rank != Rank::Ear && _left <= _leftToRescan) {
                // Corners that were in an ear's way may have gone since it was looked at.
                _leftToRescan = _left / 2;
                _PushAll(best.corner);
                continue;
            }
            triangles.push_back(_Triangle(best.corner));
            _Remove(best.corner);
        }
        const auto last = std::find(_isLeft.begin(), _isLeft.end(), 1) - _isLeft.begin();
        triangles.push_back(_Triangle(static_cast<uint32_t>(last)));
        return triangles;
    }

  private:
    struct Candidate {
        Rank rank;
        double diagonal;  ///< its square
        uint32_t corner;
        uint32_t version;

        bool operator>(const Candidate& b) const {
            return std::tie(rank, diagonal, corner) > std::tie(b.rank, b.diagonal, b.corner);
        }
    };

    /// What a turn may be off by.
    static double _Tolerance(const Vec2d& a, const Vec2d& b) {
        return kStraight * (std::fabs(b.x - a.x) + std::fabs(b.y - a.y));
    }

    /// 1 at a corner that turns left, -1 at one that turns right, 0 at a straight one.
    int _Turn(uint32_t corner) const {
        const Vec2d &a = _at[_previous[corner]], &b = _at[corner], &c = _at[_next[corner]];
        const double turn = Cross(a, b, c);
        const double tolerance = std::max(_Tolerance(a, b), _Tolerance(b, c));
        return turn > tolerance ? 1 : turn < -tolerance ? -1 : 0;
    }

    void _NoteReflex(uint32_t corner) {
        if (!_isInGrid[corner] && _Turn(corner) <= 0) {
            _isInGrid[corner] = 1;
            _grid.Add(corner, _at[corner]);
        }
    }

    bool _IsBlocked(uint32_t corner) {
        const Vec2d &a = _at[_previous[corner]], &b = _at[corner], &c = _at[_next[corner]];
        const double ab = -_Tolerance(a, b), bc = -_Tolerance(b, c), ca = -_Tolerance(c, a);
        const Vec2d lower{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
        const Vec2d upper{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
        bool isBlocked = false;
        _grid.ForEach(lower, upper, [&](uint32_t other) {
            using Then = CornerGrid::Then;
            --_looksLeft;
            if (!_isLeft[other] || _Turn(other) > 0) {
                _isInGrid[other] = 0;
                return Then::Remove;
            }
            const Vec2d& p = _at[other];
            isBlocked = Cross(a, b, p) >= ab && Cross(b, c, p) >= bc && Cross(c, a, p) >= ca &&
                        !IsSame(p, a) && !IsSame(p, b) && !IsSame(p, c);
            return isBlocked || _looksLeft <= 0 ? Then::Stop : Then::GoOn;
        });
        return isBlocked;
    }

    Rank _RankOf(uint32_t corner) {
        const int turn = _Turn(corner);
        if (turn <= 0) {
            return turn == 0 ? Rank::Straight : Rank::Reflex;
        }
        return _IsBlocked(corner) ? Rank::Blocked : Rank::Ear;
    }

    void _Push(uint32_t corner) {
        const Vec3f &a = _corners[_previous[corner]], &c = _corners[_next[corner]];
        const double x = double(c.x) - a.x, y = double(c.y) - a.y, z = double(c.z) - a.z;
        _candidates.push({_RankOf(corner), x * x + y * y + z * z, corner, ++_version[corner]});
    }

    void _PushAll(uint32_t first) {
        uint32_t corner = first;
        do {
            _Push(corner);
            corner = _next[corner];
        } while (corner != first);
    }

    Candidate _TakeBest() {
        for (;;) {
            const Candidate best = _candidates.top();
            _candidates.pop();
            if (_isLeft[best.corner] && _version[best.corner] == best.version) {
                return best;
            }
        }
    }

    PolygonTriangle _Triangle(uint32_t corner) const {
        PolygonTriangle triangle{_previous[corner], corner, _next[corner]};
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                    triangle.end());
        return triangle;
    }

    void _Remove(uint32_t corner) {
        const uint32_t previous = _previous[corner], next = _next[corner];
        _isLeft[corner] = 0;
        --_left;
        _next[previous] = next;
        _previous[next] = previous;
        _NoteReflex(previous);
        _NoteReflex(next);
        _Push(previous);
        _Push(next);
    }

    const std::vector<Vec3f>& _corners;
    std::vector<Vec2d> _at;
    std::vector<uint32_t> _next, _previous;
    /// Candidates with an older version of their corner are out of date.
    std::vector<uint32_t> _version;
    std::vector<char> _isLeft, _isInGrid;
    /// Of the corners that do not turn left, which alone can be in an ear's way, and of some more.
    CornerGrid _grid;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<Candidate>> _candidates;
    size_t _left;
    /// All corners are looked at again once so few are left.
    size_t _leftToRescan = static_cast<size_t>(-1);
    int64_t _looksLeft;
};

/// True if a quad lies on both sides of its diagonal from corner 0 to corner 2.
bool IsCutFromFirstCorner(const std::vector<Vec3f>& quad) {
    const std::vector<Vec2d> at = Project(quad);
    return Cross(at[0], at[1], at[2]) > 0 && Cross(at[0], at[2], at[3]) > 0;
}

}  // namespace

std::vector<PolygonTriangle> TriangulatePolygon(const std::vector<Vec3f>& corners) {
    if (corners.size() < 3) {
        return {};
    }
    if (corners.size() == 3) {
        return {{0, 1, 2}};
    }
    if (corners.size() == 4 && IsCutFromFirstCorner(corners)) {
        return {{0, 1, 2}, {0, 2, 3}};
    }
    return EarClipper(corners).Clip();
}

}  // namespace cc
