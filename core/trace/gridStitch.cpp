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
    const auto step = [&](int level) { return std::min(1 << (levels.Finest() - level), side); };
    _innerStep = step(levels.interior);
    _isNeeded = _innerStep > 1;
    for (int edge = 0; edge < 4; ++edge) {
        const int border = isTransposed ? kTransposed[edge] : edge;
        _isEdge[border] = isOnEdge[edge];
        _steps[border] = isOnEdge[edge] ? step(levels.edges[edge]) : _innerStep;
        _isNeeded |= _steps[border] > 1;
    }
}

int GridStitch::_MoveInside(int i, bool isLowEdge, bool isHighEdge) const {
    const int least = isLowEdge ? _innerStep : 0, most = _side - (isHighEdge ? _innerStep : 0);
    // A single quad inside has no point of its own: fans meet in the middle.
    return least > most ? _side / 2 : std::min(std::max(_Nearest(i, _innerStep), least), most);
}

void GridStitch::Move(int* column, int* row) const {
    const int c = *column, r = *row;
    const int rowBorder = r == 0 ? kLowRow : kHighRow;
    const int columnBorder = c == 0 ? kLowColumn : kHighColumn;
    const bool isOnRow = (r == 0 || r == _side) && _isEdge[rowBorder];
    const bool isOnColumn = (c == 0 || c == _side) && _isEdge[columnBorder];
    if (isOnRow) {
        *column = _Nearest(c, _steps[rowBorder]);
    } else if (!isOnColumn) {
        *column = _MoveInside(c, _isEdge[kLowColumn], _isEdge[kHighColumn]);
    }
    if (isOnColumn) {
        *row = _Nearest(r, _steps[columnBorder]);
    } else if (!isOnRow) {
        *row = _MoveInside(r, _isEdge[kLowRow], _isEdge[kHighRow]);
    }
}

float GridStitch::Apply(LimitGrid* grid) const {
    const float deviation = std::max(_BorderDeviation(*grid), _InnerDeviation(*grid));
    // Points that others move onto stay where they are.
    for (int row = 0; row <= _side; ++row) {
        const bool isInside = row > 0 && row < _side && _innerStep == 1;
        for (int column = 0; column <= _side; column += isInside ? _side : 1) {
            int fromColumn = column, fromRow = row;
            Move(&fromColumn, &fromRow);
            for (auto& points : grid->points) {
                points[row][column] = points[fromRow][fromColumn];
            }
        }
    }
    return deviation;
}

float GridStitch::_BorderDeviation(const LimitGrid& grid) const {
    const auto at = [&](int border, int i) {
        switch (border) {
            case kLowRow: return grid.At(0, i);
            case kHighRow: return grid.At(_side, i);
            case kLowColumn: return grid.At(i, 0);
            default: return grid.At(i, _side);
        }
    };
    float square = 0;
    for (int border = 0; border < 4; ++border) {
        const int step = _steps[border];
        for (int i = 0; i < _side && step > 1; ++i) {
            const int first = i / step * step;
            const float part = static_cast<float>(i - first) / static_cast<float>(step);
            const Vec3f off =
                at(border, i) - ((1 - part) * at(border, first) + part * at(border, first + step));
            square = std::max(square, Dot(off, off));
        }
    }
    return std::sqrt(square);
}

float GridStitch::_InnerDeviation(const LimitGrid& grid) const {
    const int step = _innerStep;
    float square = 0, twist = 0;
    for (int row = 0; row < _side && step > 1; ++row) {
        for (int column = 0; column < _side; ++column) {
            const int r = row / step * step, c = column / step * step;
            const float v = static_cast<float>(row - r) / static_cast<float>(step);
            const float u = static_cast<float>(column - c) / static_cast<float>(step);
            const Vec3f corners[4] = {grid.At(r, c), grid.At(r, c + step),
                                      grid.At(r + step, c + step), grid.At(r + step, c)};
            const Vec3f off = grid.At(row, column) -
                              (((1 - u) * (1 - v)) * corners[0] + (u * (1 - v)) * corners[1] +
                               (u * v) * corners[2] + ((1 - u) * v) * corners[3]);
            const Vec3f bent = (corners[0] - corners[1]) + (corners[2] - corners[3]);
            square = std::max(square, Dot(off, off));
            twist = std::max(twist, Dot(bent, bent));
        }
    }
    return std::sqrt(square) + 0.25f * std::sqrt(twist);
}

void GridStitch::_Extend(int step, int side, int* first, int* last) {
    *first = *first / step * step;
    *last = std::min((*last / step + 1) * step, side) - 1;
}

void GridStitch::Widen(int* firstColumn, int* lastColumn, int* firstRow, int* lastRow) const {
    _Extend(_innerStep, _side, firstColumn, lastColumn);
    _Extend(_innerStep, _side, firstRow, lastRow);
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
    const bool isUpper = (triangle & 1) != 0;
    const float across = *u - static_cast<float>(column), along = *v - static_cast<float>(row);
    // Of the corners (0,0), the one beside the diagonal, and (1,1).
    const float most = std::max(across, along), least = std::min(across, along);
    const float weights[3] = {1 - most, most - least, least};
    const int corners[3][2] = {{0, 0}, {isUpper ? 0 : 1, isUpper ? 1 : 0}, {1, 1}};
    *u = *v = 0;
    for (int i = 0; i < 3; ++i) {
        int movedColumn = column + corners[i][0], movedRow = row + corners[i][1];
        Move(&movedColumn, &movedRow);
        *u += weights[i] * static_cast<float>(movedColumn);
        *v += weights[i] * static_cast<float>(movedRow);
    }
    *u = std::min(*u, static_cast<float>(_side));
    *v = std::min(*v, static_cast<float>(_side));
}

bool GridStitch::IsInFan(int column, int row) const {
    const auto isJoint = [this](Border border) {
        return _isEdge[border] && _steps[border] != _innerStep;
    };
    return (row < _innerStep && isJoint(kLowRow)) ||
           (row >= _side - _innerStep && isJoint(kHighRow)) ||
           (column < _innerStep && isJoint(kLowColumn)) ||
           (column >= _side - _innerStep && isJoint(kHighColumn));
}

bool GridStitch::IsInFan(const Vec2f& at) const {
    const auto quad = [this](float x) {
        return std::min(static_cast<int>(x * static_cast<float>(_side)), _side - 1);
    };
    return IsInFan(quad(at.x), quad(at.y));
}

}  // namespace cc
