#include "core/trace/gridStitch.h"

#include <algorithm>
#include <cmath>

namespace cc {

GridStitch::GridStitch(const PatchLevels& levels, const Square& square, int side, bool isTransposed)
    : _side(side) {
    // Edges in the order of borders; transposed, rows and columns change places.
    static constexpr int kTransposed[4] = {kLowColumn, kHighRow, kHighColumn, kLowRow};
    const bool isOnEdge[4] = {square.v == 0, square.u + square.size == 1,
                              square.v + square.size == 1, square.u == 0};
    for (int edge = 0; edge < 4; ++edge) {
        if (isOnEdge[edge]) {
            const int border = isTransposed ? kTransposed[edge] : edge;
            _steps[border] = std::min(1 << (levels.interior - levels.edges[edge]), side);
        }
    }
}

void GridStitch::_Move(int* column, int* row) const {
    const int c = *column, r = *row;
    if (r == 0 || r == _side) {
        *column = _Nearest(c, _steps[r == 0 ? kLowRow : kHighRow]);
    }
    if (c == 0 || c == _side) {
        *row = _Nearest(r, _steps[c == 0 ? kLowColumn : kHighColumn]);
    }
}

float GridStitch::Apply(LimitGrid* grid) const {
    float square = 0;
    const auto moveBorder = [&](Border border, const auto& at) {
        const int step = _steps[border];
        Vec3f ends[2];
        for (int first = 0; step > 1 && first < _side; first += step) {
            at(first, nullptr, &ends[0]);
            at(first + step, nullptr, &ends[1]);
            for (int i = 1; i < step; ++i) {
                Vec3f point;
                at(first + i, &ends[_Nearest(i, step) == 0 ? 0 : 1], &point);
                const float part = static_cast<float>(i) / static_cast<float>(step);
                const Vec3f off = point - ((1 - part) * ends[0] + part * ends[1]);
                square = std::max(square, Dot(off, off));
            }
        }
    };
    // Reads a point, and then writes another there.
    const auto access = [&](int row, int column, const Vec3f* to, Vec3f* from) {
        *from = grid->At(row, column);
        for (int axis = 0; to && axis < 3; ++axis) {
            grid->points[axis][row][column] = (*to)[axis];
        }
    };
    const auto row = [&](int fixed) {
        return [&, fixed](int i, const Vec3f* to, Vec3f* from) { access(fixed, i, to, from); };
    };
    const auto column = [&](int fixed) {
        return [&, fixed](int i, const Vec3f* to, Vec3f* from) { access(i, fixed, to, from); };
    };
    moveBorder(kLowRow, row(0));
    moveBorder(kHighRow, row(_side));
    moveBorder(kLowColumn, column(0));
    moveBorder(kHighColumn, column(_side));
    return std::sqrt(square);
}

void GridStitch::_Extend(int step, int side, int* first, int* last) {
    *first = *first / step * step;
    *last = std::min((*last / step + 1) * step, side) - 1;
}

void GridStitch::Widen(int* firstColumn, int* lastColumn, int* firstRow, int* lastRow) const {
    const bool isLowRow = *firstRow == 0, isHighRow = *lastRow >= _side - 1;
    const bool isLowColumn = *firstColumn == 0, isHighColumn = *lastColumn >= _side - 1;
    const int alongRows =
        std::max(isLowRow ? _steps[kLowRow] : 1, isHighRow ? _steps[kHighRow] : 1);
    const int alongColumns =
        std::max(isLowColumn ? _steps[kLowColumn] : 1, isHighColumn ? _steps[kHighColumn] : 1);
    _Extend(alongRows, _side, firstColumn, lastColumn);
    _Extend(alongColumns, _side, firstRow, lastRow);
}

void GridStitch::ToUnmoved(int triangle, float* u, float* v) const {
    const int quad = triangle / 2, column = quad % _side, row = quad / _side;
    if (!IsInFan(column, row)) {
        return;
    }
    const bool isUpper = (triangle & 1) != 0;
    const float across = *u - static_cast<float>(column), along = *v - static_cast<float>(row);
    // Of the corners (0,0), the one beside the diagonal, and (1,1).
    const float most = std::max(across, along), least = std::min(across, along);
    const float weights[3] = {1 - most, most - least, least};
    const int corners[3][2] = {{0, 0}, {isUpper ? 0 : 1, isUpper ? 1 : 0}, {1, 1}};
    *u = *v = 0;
    for (int i = 0; i < 3; ++i) {
        int movedColumn = column + corners[i][0], movedRow = row + corners[i][1];
        _Move(&movedColumn, &movedRow);
        *u += weights[i] * static_cast<float>(movedColumn);
        *v += weights[i] * static_cast<float>(movedRow);
    }
    *u = std::min(*u, static_cast<float>(_side));
    *v = std::min(*v, static_cast<float>(_side));
}

bool GridStitch::IsInFan(int column, int row) const {
    return (row == 0 && _steps[kLowRow] > 1) || (row == _side - 1 && _steps[kHighRow] > 1) ||
           (column == 0 && _steps[kLowColumn] > 1) ||
           (column == _side - 1 && _steps[kHighColumn] > 1);
}

bool GridStitch::IsInFan(const Vec2f& at) const {
    const auto quad = [this](float x) {
        return std::min(static_cast<int>(x * static_cast<float>(_side)), _side - 1);
    };
    return IsInFan(quad(at.x), quad(at.y));
}

}  // namespace cc
