// SPDX-License-Identifier: MIT
#include <osgMultiRender/Plan.h>

#include <iomanip>
#include <iterator>
#include <sstream>

namespace osgMultiRender
{

Planned::~Planned() = default;

const char* toString(PlanEntry::Decision decision)
{
    switch (decision)
    {
    case PlanEntry::Decision::Drawn:
        return "drawn";
    case PlanEntry::Decision::Folded:
        return "folded";
    case PlanEntry::Decision::Dropped:
        break;
    }
    return "dropped";
}

namespace
{

bool isBytes(const std::string& name)
{
    return name.find(".bytes") != std::string::npos || name == "textureBytes";
}

std::string bytesToString(double bytes)
{
    static const char* const units[] = {"bytes", "KiB", "MiB", "GiB"};
    std::size_t unit = 0;
    for (; bytes >= 1024.0 && unit + 1 < std::size(units); ++unit)
        bytes /= 1024.0;
    std::ostringstream text;
    text << std::setprecision(4) << bytes << " " << units[unit];
    return text.str();
}

} // namespace

std::string toString(const Plan& plan)
{
    std::ostringstream text;
    text << plan.kit << ", " << plan.view << ", frame " << plan.frame << ":\n";
    for (const PlanEntry& entry : plan.entries)
    {
        text << "  " << entry.subject << ": " << toString(entry.decision);
        if (!entry.reason.empty())
            text << ", " << entry.reason;
        text << "\n";
    }
    for (const auto& [name, value] : plan.counts)
    {
        text << "  " << name << " = ";
        if (isBytes(name))
            text << bytesToString(value) << "\n";
        else
            text << value << "\n";
    }
    return text.str();
}

} // namespace osgMultiRender
