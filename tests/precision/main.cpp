// SPDX-License-Identifier: MIT
#include <precision/Measure.h>
#include <precision/Report.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace
{

const char Usage[] =
    "precision [options] [sweep...]: measures error against run time; without names, all sweeps.\n"
    "  --list        print the names of the sweeps\n"
    "  --rounds N    timed rounds, 1 to 10000 (15)\n"
    "  --warm-ups N  untimed rounds before, 0 to 10000 (2)\n"
    "  --output DIR  where <sweep>.csv, .svg and .gp go (precision)\n"
    "  --help        print this\n";

struct Arguments
{
    precision::Rounds rounds;
    std::filesystem::path output = "precision";
    std::vector<std::string> names;
    bool isList = false;
    bool isHelp = false;
};

bool parseCount(const std::string& text, int low, int& count)
{
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, count);
    return failure == std::errc() && stop == end && count >= low && count <= 10000;
}

/// False after a line about the argument that is wrong.
bool parse(const std::vector<std::string>& words, Arguments& arguments)
{
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        const std::string& word = words[i];
        const std::string next = i + 1 < words.size() ? words[i + 1] : "";
        bool isGood = true;
        if (word == "--list")
        {
            arguments.isList = true;
        }
        else if (word == "--help" || word == "-h")
        {
            arguments.isHelp = true;
        }
        else if (word == "--rounds" || word == "--warm-ups")
        {
            const bool isTimed = word == "--rounds";
            isGood = parseCount(next, isTimed ? 1 : 0,
                                isTimed ? arguments.rounds.timed : arguments.rounds.warmUps);
            ++i;
        }
        else if (word == "--output")
        {
            isGood = !next.empty();
            arguments.output = next;
            ++i;
        }
        else
        {
            const auto& sweeps = precision::getSweeps();
            isGood = std::any_of(sweeps.begin(), sweeps.end(),
                                 [&](const auto& sweep) { return sweep.name == word; });
            arguments.names.push_back(word);
        }
        if (!isGood)
        {
            std::cerr << "precision: bad argument or unknown sweep '" << word << ' ' << next
                      << "'; see --help and --list\n";
            return false;
        }
    }
    return true;
}

bool runSweep(const precision::Entry& entry, const Arguments& arguments)
{
    const precision::Sweep sweep = entry.makeSweep();
    const auto measurements = precision::measure(
        sweep, arguments.rounds,
        [&](int round, int count)
        { std::cerr << '\r' << entry.name << ": round " << round << '/' << count << std::flush; });
    std::cerr << '\n';
    std::filesystem::create_directories(arguments.output);
    const std::string stem = (arguments.output / entry.name).string();
    std::ofstream csv(stem + ".csv");
    precision::writeCsv(csv, sweep, measurements);
    std::ofstream plot(stem + ".gp");
    precision::writePlot(plot, sweep, measurements, stem + ".svg");
    plot.close();
    precision::printTable(std::cout, sweep, measurements);
    const bool isPlotted = std::system(("gnuplot '" + stem + ".gp'").c_str()) == 0;
    if (!isPlotted)
    {
        std::cerr << "precision: gnuplot failed on " << stem << ".gp; is gnuplot-nox installed?\n";
    }
    const bool hasFailed =
        std::any_of(measurements.begin(), measurements.end(),
                    [](const auto& measurement) { return measurement.hasFailed(); });
    return csv.good() && isPlotted && !hasFailed;
}

} // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    if (!parse({argv + 1, argv + argc}, arguments))
    {
        return 2;
    }
    if (arguments.isHelp)
    {
        std::cout << Usage;
        return 0;
    }
    int failures = 0;
    for (const precision::Entry& entry : precision::getSweeps())
    {
        const auto& names = arguments.names;
        if (arguments.isList)
        {
            std::cout << entry.name << '\n';
        }
        else if (names.empty() || std::count(names.begin(), names.end(), entry.name))
        {
            try
            {
                failures += runSweep(entry, arguments) ? 0 : 1;
            }
            catch (const std::exception& exception)
            {
                std::cerr << "precision: " << entry.name << ": " << exception.what() << '\n';
                ++failures;
            }
        }
    }
    return failures ? 1 : 0;
}
