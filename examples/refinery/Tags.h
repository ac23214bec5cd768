// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Names as plants have them, counted by unit and kind.
class Tags
{
public:
    /// Of unit 1 and up.
    void startUnit(unsigned int unit);

    /// "P-1203A": letters, unit and running number, and one of a pair where `suffix` is a letter.
    std::string equipment(const std::string& letters, char suffix = 0);
    /// A new line, such as "10\"-HC-12047-A1B"; its diameter is the next standard one.
    std::string line(double radiusMetres, const std::string& service);
    /// "ST-12-C0047": steel, its kind by a letter.
    std::string steel(char kind);

private:
    unsigned int _unit = 1, _equipment = 0, _line = 0, _steel = 0; ///< Running numbers.
    std::string _lastLetters;
};
