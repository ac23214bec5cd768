// SPDX-License-Identifier: MIT
#include <osgPagedTexture/Residency.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace osgPagedTexture
{

namespace
{

constexpr double Hysteresis = 0.25; ///< Levels.
constexpr int StepsPerLevel = 16;   ///< Of the bias that is looked for.
constexpr int MaxLevels = 32;

bool isWished(double need)
{
    return need >= 0.0; // NaN is no wish.
}

int levelAt(const ResidencyWish& wish, double level)
{
    return int(std::floor(std::clamp(level, 0.0, double(wish.levels - 1))));
}

/// The level of a texture in view where all are coarser by `bias`. A finer one that is there stays
/// while the need is hardly below it.
int levelOf(const ResidencyWish& wish, double bias)
{
    const int level = levelAt(wish, wish.need + bias);
    if (wish.resident < 0 || wish.resident >= level)
        return level;
    return std::max(wish.resident, levelAt(wish, wish.need + bias - Hysteresis));
}

class Division
{
public:
    Division(const std::vector<ResidencyWish>& wishes, std::uint64_t budget, std::uint64_t others)
        : _wishes(wishes), _budget(budget), _others(others)
    {
        _plan.first.assign(wishes.size(), -1);
        for (std::size_t i = 0; i < wishes.size(); ++i)
            if (wishes[i].levels > 0 && isWished(wishes[i].need))
                _inView.push_back(i);
    }

    ResidencyPlan divide()
    {
        _plan.isWhole = fitsWhole();
        giveInView();
        giveSoon();
        keepResident();
        return std::move(_plan);
    }

private:
    bool fitsWhole() const
    {
        std::uint64_t bytes = _others;
        for (const ResidencyWish& wish : _wishes)
            bytes += wish.levels > 0 ? wish.bytes[0] : 0;
        return bytes <= _budget;
    }

    std::uint64_t cost(double bias) const
    {
        std::uint64_t bytes = 0;
        for (const std::size_t i : _inView)
            bytes += _wishes[i].bytes[levelOf(_wishes[i], bias)];
        return bytes;
    }

    /// Makes a texture finer if that fits.
    bool refine(std::size_t index, int level)
    {
        const ResidencyWish& wish = _wishes[index];
        const int had = _plan.first[index];
        const std::uint64_t bytes =
            _plan.bytes + wish.bytes[level] - (had < 0 ? 0 : wish.bytes[had]);
        if (bytes > _budget)
            return false;
        _plan.bytes = bytes;
        _plan.first[index] = level;
        return true;
    }

    void giveInView()
    {
        if (_plan.isWhole)
        {
            for (const std::size_t i : _inView)
                refine(i, 0);
            return;
        }
        int low = 0, high = MaxLevels * StepsPerLevel;
        while (low < high)
        {
            const int middle = (low + high) / 2;
            if (cost(double(middle) / StepsPerLevel) <= _budget)
                high = middle;
            else
                low = middle + 1;
        }
        _plan.bias = double(low) / StepsPerLevel;
        // Those whose need is the finest come first, should not even the last levels fit.
        std::vector<std::size_t> order = _inView;
        if (low == MaxLevels * StepsPerLevel)
            std::stable_sort(order.begin(), order.end(),
                             [this](std::size_t a, std::size_t b)
                             { return _wishes[a].need < _wishes[b].need; });
        for (const std::size_t i : order)
            refine(i, levelOf(_wishes[i], _plan.bias));
        if (low > 0)
            spendRest();
    }

    /// What a step of the bias left over goes to those that were just before their finer level.
    void spendRest()
    {
        const double finer = _plan.bias - 1.0 / StepsPerLevel;
        std::vector<std::size_t> next;
        for (const std::size_t i : _inView)
            if (levelOf(_wishes[i], finer) < _plan.first[i])
                next.push_back(i);
        std::stable_sort(next.begin(), next.end(),
                         [this](std::size_t a, std::size_t b)
                         { return _wishes[a].need < _wishes[b].need; });
        for (const std::size_t i : next)
            refine(i, levelOf(_wishes[i], finer));
    }

    void giveSoon()
    {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < _wishes.size(); ++i)
        {
            const ResidencyWish& wish = _wishes[i];
            if (wish.levels <= 0 || !isWished(wish.soon))
                continue;
            const int level = _plan.isWhole ? 0 : levelAt(wish, wish.soon);
            if (_plan.first[i] < 0 || level < _plan.first[i])
                order.push_back(i);
        }
        std::stable_sort(order.begin(), order.end(),
                         [this](std::size_t a, std::size_t b)
                         { return _wishes[a].soon < _wishes[b].soon; });
        for (const std::size_t i : order)
            refine(i, _plan.isWhole ? 0 : levelAt(_wishes[i], _wishes[i].soon));
    }

    void keepResident()
    {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < _wishes.size(); ++i)
            if (_wishes[i].levels > 0 && _wishes[i].resident >= 0 &&
                (_plan.first[i] < 0 || _wishes[i].resident < _plan.first[i]))
                order.push_back(i);
        std::stable_sort(order.begin(), order.end(),
                         [this](std::size_t a, std::size_t b)
                         { return _wishes[a].lastUsed > _wishes[b].lastUsed; });
        for (const std::size_t i : order)
        {
            const int coarsest = _plan.first[i] < 0 ? _wishes[i].levels : _plan.first[i];
            for (int level = _wishes[i].resident; level < coarsest; ++level)
                if (refine(i, level))
                    break;
        }
    }

    const std::vector<ResidencyWish>& _wishes;
    const std::uint64_t _budget, _others;
    std::vector<std::size_t> _inView;
    ResidencyPlan _plan;
};

} // namespace

ResidencyPlan planResidency(const std::vector<ResidencyWish>& wishes, std::uint64_t budget,
                            std::uint64_t others)
{
    return Division(wishes, budget, others).divide();
}

} // namespace osgPagedTexture
