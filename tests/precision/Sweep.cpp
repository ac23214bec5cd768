// SPDX-License-Identifier: MIT
#include <precision/Sweep.h>

#include <algorithm>

namespace precision
{

namespace
{

std::vector<Entry>& sweeps()
{
    static std::vector<Entry> all;
    return all;
}

} // namespace

Registration::Registration(const std::string& name, std::function<Sweep()> makeSweep)
{
    const Entry entry{name, std::move(makeSweep)};
    const auto place =
        std::lower_bound(sweeps().begin(), sweeps().end(), entry,
                         [](const Entry& a, const Entry& b) { return a.name < b.name; });
    sweeps().insert(place, entry);
}

const std::vector<Entry>& getSweeps()
{
    return sweeps();
}

} // namespace precision
