#pragma once

#include <string>
#include <vector>

namespace cc::test {

/// A rectangle of a letter, in dots: columns from the left, rows from the top down.
struct LetterStroke {
    int column, row, columns, rows;
};

/// Dots from one letter to the next, and from one line to the next.
constexpr int kLetterColumns = 6;
constexpr int kLineRows = 9;

/// The strokes of a letter of 5 x 7 dots, which do not overlap. Lower case looks like upper case.
/// Empty for a space and for characters that the font lacks (HasLetter).
std::vector<LetterStroke> StrokesOf(char letter);

/// True if the font has a letter, the space among them.
bool HasLetter(char letter);

/// Breaks a text between words into lines of at most so many letters; longer words stay whole.
std::vector<std::string> BreakLines(const std::string& text, int mostLetters);

}  // namespace cc::test
