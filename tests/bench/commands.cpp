#include "commands.h"

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace {

Answer Obey(const std::map<std::string, Command>& commands, const std::string& line) {
    std::istringstream stream(line);
    std::string name;
    stream >> name;
    Words words;
    for (std::string word; stream >> word;) {
        words.push_back(word);
    }
    try {
        const auto command = commands.find(name);
        if (command == commands.end()) {
            throw std::runtime_error("unknown command '" + name + "'");
        }
        return command->second(words);
    } catch (const std::exception& failure) {
        return Answer().Text("error", failure.what());
    }
}

}  // namespace

Answer& Answer::Number(const std::string& name, double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.9g", value);
    return _Add(name, text);
}

Answer& Answer::Count(const std::string& name, uint64_t value) {
    return _Add(name, std::to_string(value));
}

Answer& Answer::Text(const std::string& name, const std::string& value) {
    std::string quoted = "\"";
    for (const char c : value) {
        if (c == '"' || c == '\\') {
            quoted += '\\';
        }
        quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return _Add(name, quoted + '"');
}

Answer& Answer::_Add(const std::string& name, const std::string& value) {
    _members += (_members.empty() ? "\"" : ", \"") + name + "\": " + value;
    return *this;
}

void ServeCommands(const std::map<std::string, Command>& commands) {
    for (std::string line; std::getline(std::cin, line);) {
        std::cout << Obey(commands, line).Line() << std::endl;
    }
}

int NumberAt(const Words& words, size_t index, int lowest, int highest) {
    const std::string& text = WordAt(words, index);
    char* end = nullptr;
    const long value = std::strtol(text.c_str(), &end, 10);
    if (*end != '\0' || value < lowest || value > highest) {
        throw std::runtime_error("'" + text + "' is not a number from " + std::to_string(lowest) +
                                 " to " + std::to_string(highest));
    }
    return static_cast<int>(value);
}

const std::string& WordAt(const Words& words, size_t index) {
    if (index >= words.size()) {
        throw std::runtime_error("a word is missing");
    }
    return words[index];
}

uint64_t PeakResidentBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}
