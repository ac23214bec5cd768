// SPDX-License-Identifier: MIT
#include <osgMultiRender/Plan.h>

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
        text << "  " << name << " = " << value << "\n";
    return text.str();
}

} // namespace osgMultiRender
