#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// An answer: a JSON object on a line of its own.
class Answer {
  public:
    Answer& Number(const std::string& name, double value);
    Answer& Count(const std::string& name, uint64_t value);
    Answer& Text(const std::string& name, const std::string& value);

    std::string Line() const { return "{" + _members + "}"; }

  private:
    Answer& _Add(const std::string& name, const std::string& value);

    std::string _members;
};

using Words = std::vector<std::string>;
/// Takes the words after the command's name; throws std::runtime_error if it cannot be done.
using Command = std::function<Answer(const Words&)>;

/// Answers commands from standard input, a line each, until it ends. What a command throws is
/// answered as {"error": ...}.
void ServeCommands(const std::map<std::string, Command>& commands);

/// The word at an index as a number. Throws if there is none, or out of range.
int NumberAt(const Words& words, size_t index, int lowest, int highest);
const std::string& WordAt(const Words& words, size_t index);

/// Most memory that this process has held so far, in bytes.
uint64_t PeakResidentBytes();
