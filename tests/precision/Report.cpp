// SPDX-License-Identifier: MIT
#include <precision/Report.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <limits>
#include <ostream>
#include <sstream>
#include <thread>

namespace precision
{

namespace
{

constexpr double Milliseconds = 1000.0;

double getMilliseconds(const Measurement& measurement, double share)
{
    return Milliseconds * getQuantile(measurement.seconds, share);
}

/// A field of a CSV line.
std::string quoteCsv(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos)
    {
        return text;
    }
    std::string quoted = "\"";
    for (char c : text)
    {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + "\"";
}

/// A string of gnuplot.
std::string quotePlot(const std::string& text)
{
    std::string quoted = "\"";
    for (char c : text)
    {
        quoted += c == '\n'               ? "\\n"
                  : c == '"' || c == '\\' ? std::string("\\") + c
                                          : std::string(1, c);
    }
    return quoted + "\"";
}

/// Where an error of 0 is drawn on the logarithmic axis.
double getFloor(const std::vector<Measurement>& measurements)
{
    double smallest = std::numeric_limits<double>::infinity();
    for (const Measurement& measurement : measurements)
    {
        if (!measurement.hasFailed() && measurement.error > 0.0)
        {
            smallest = std::min(smallest, measurement.error);
        }
    }
    return smallest < std::numeric_limits<double>::infinity() ? smallest / 10.0 : 1e-9;
}

bool hasPoints(const std::vector<Measurement>& measurements)
{
    return std::any_of(measurements.begin(), measurements.end(),
                       [](const Measurement& measurement) { return !measurement.hasFailed(); });
}

void writeFailures(std::ostream& out, const std::vector<Measurement>& measurements)
{
    double height = 0.97;
    for (const Measurement& measurement : measurements)
    {
        if (measurement.hasFailed())
        {
            std::ostringstream text;
            text << measurement.method << ", " << measurement.knob << ' ' << measurement.value
                 << ": failed";
            out << "set label " << quotePlot(text.str()) << " at graph 0.02, graph " << height
                << " offset 1,0 point pointtype 2 linecolor rgb 'red' textcolor rgb 'red'\n";
            height -= 0.05;
        }
    }
}

/// Place, lower and upper end of the bar, label.
void writePoint(std::ostream& out, const Sweep& sweep, const Measurement& measurement, double error)
{
    if (!sweep.budgetName.empty())
    {
        out << measurement.value << ' ' << error << ' ' << error << ' ' << error;
    }
    else
    {
        out << error << ' ' << getMilliseconds(measurement, 0.5) << ' '
            << getMilliseconds(measurement, 0.1) << ' ' << getMilliseconds(measurement, 0.9);
    }
    out << ' ' << measurement.value << '\n';
}

void writeAxes(std::ostream& out, const Sweep& sweep)
{
    const bool isTime = sweep.budgetName.empty();
    out << "\nset xlabel " << quotePlot(isTime ? sweep.errorName : sweep.budgetName)
        << "\nset ylabel "
        << quotePlot(isTime ? "run time, ms (median, p10 to p90)" : sweep.errorName)
        << "\nset logscale xy\n";
    if (isTime)
    {
        out << "set format xy '10^{%T}'\n";
    }
}

void writeLines(std::ostream& out, const Sweep& sweep)
{
    const char* separator = "plot ";
    int block = 0;
    for (const Method& method : sweep.methods)
    {
        ++block;
        out << separator << "$m" << block << " using 1:2:3:4 with yerrorlines linetype " << block
            << " pointtype 7 pointsize 0.5 title "
            << quotePlot(method.name + " (" + method.knob + ")") << ", $m" << block
            << " using 1:2:5 with labels offset 1.2,0.6 font ',10' notitle";
        separator = ", ";
    }
    out << '\n';
}

} // namespace

std::string describeMachine()
{
    std::ifstream info("/proc/cpuinfo");
    std::string model = "unknown CPU";
    for (std::string line; std::getline(info, line);)
    {
        const auto colon = line.find(": ");
        if (line.compare(0, 10, "model name") == 0 && colon != std::string::npos)
        {
            model = line.substr(colon + 2);
            break;
        }
    }
    return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores";
}

void writeCsv(std::ostream& out, const Sweep& sweep, const std::vector<Measurement>& measurements)
{
    out << "# " << sweep.title << "\n# error: " << sweep.errorName
        << "\n# machine: " << describeMachine() << "\n# renderer: " << sweep.renderer << '\n'
        << "method,knob,value,status,error,median_ms,p10_ms,p90_ms,rounds,message\n";
    for (const Measurement& measurement : measurements)
    {
        out << quoteCsv(measurement.method) << ',' << quoteCsv(measurement.knob) << ','
            << measurement.value << ',';
        if (measurement.hasFailed())
        {
            out << "failed,,,,," << measurement.seconds.size() << ','
                << quoteCsv(measurement.failure) << '\n';
            continue;
        }
        out << "ok," << measurement.error << ',' << getMilliseconds(measurement, 0.5) << ','
            << getMilliseconds(measurement, 0.1) << ',' << getMilliseconds(measurement, 0.9) << ','
            << measurement.seconds.size() << ",\n";
    }
}

void writePlot(std::ostream& out, const Sweep& sweep, const std::vector<Measurement>& measurements,
               const std::string& svgName)
{
    const double floor = getFloor(measurements);
    int block = 0;
    for (const Method& method : sweep.methods)
    {
        out << "$m" << ++block << " << EOD\n";
        for (const Measurement& measurement : measurements)
        {
            if (measurement.method == method.name && !measurement.hasFailed())
            {
                writePoint(out, sweep, measurement, std::max(measurement.error, floor));
            }
        }
        out << "EOD\n";
    }
    out << "set terminal svg size 900,600 font 'sans,13' background rgb 'white'\n"
        << "set output " << quotePlot(svgName) << "\nset title "
        << quotePlot(sweep.title + "\n" + describeMachine() + "; " + sweep.renderer)
        << " noenhanced font ',12'";
    writeAxes(out, sweep);
    out << "set grid\nset offsets graph 0.08, graph "
           "0.08, "
           "graph 0.12, graph 0.05\nset key outside below\n";
    writeFailures(out, measurements);
    if (hasPoints(measurements))
    {
        writeLines(out, sweep);
    }
    else
    {
        out << "set xrange [1e-6:1]\nset yrange [0.1:100]\nplot NaN notitle\n";
    }
}

void printTable(std::ostream& out, const Sweep& sweep, const std::vector<Measurement>& measurements)
{
    out << sweep.title << '\n'
        << describeMachine() << "; " << sweep.renderer << "\n\n"
        << std::left << std::setw(28) << "method" << std::setw(18) << "knob" << std::right
        << std::setw(8) << "value" << std::setw(13) << "error" << std::setw(13) << "median ms"
        << std::setw(11) << "p10" << std::setw(11) << "p90" << '\n';
    for (const Measurement& measurement : measurements)
    {
        out << std::left << std::setw(28) << measurement.method << std::setw(18) << measurement.knob
            << std::right << std::setw(8) << measurement.value;
        if (measurement.hasFailed())
        {
            out << "  FAILED: " << measurement.failure << '\n';
            continue;
        }
        out << std::setw(13) << std::setprecision(4) << measurement.error;
        for (double share : {0.5, 0.1, 0.9})
        {
            out << std::setw(share == 0.5 ? 13 : 11) << getMilliseconds(measurement, share);
        }
        out << '\n';
    }
    out << "\nerror: " << sweep.errorName << '\n';
}

} // namespace precision
