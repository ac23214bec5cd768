// SPDX-License-Identifier: MIT
#include <osgPagedTexture/Residency.h>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

constexpr int StepsPerLevel = 16; ///< Levels and biases are counted in these.
constexpr int Hysteresis = StepsPerLevel / 4;
constexpr int MaxLevels = 32;
constexpr int MaxBias = MaxLevels * StepsPerLevel;

bool isWished(double need)
{
    return need >= 0.0; // NaN is no wish.
}

int stepsOf(double level)
{
    return int(std::floor(std::min(level, double(MaxLevels)) * StepsPerLevel));
}

/// A wish of what is in view, in few bytes: there may be many.
struct Viewed
{
    std::size_t index;
    const std::uint64_t* bytes;
    int need; ///< Steps.
    int resident;
    int last; ///< The coarsest level.

    int levelAt(int steps) const { return std::clamp(steps / StepsPerLevel, 0, last); }

    /// Its level where all are coarser by `bias`. A finer one that is there stays while the need is
    /// hardly below it.
    int levelOf(int bias) const
    {
        const int level = levelAt(need + bias);
        if (resident < 0 || resident >= level)
            return level;
        return std::max(resident, levelAt(need + bias - Hysteresis));
    }

    /// The least bias from which on levelOf() is `level` or coarser.
    int biasOf(int level) const
    {
        const bool stays = resident >= 0 && resident < level;
        return level * StepsPerLevel - need + (stays ? Hysteresis : 0);
    }
};

class Division
{
public:
    Division(const std::vector<ResidencyWish>& wishes, std::uint64_t budget, std::uint64_t others)
        : _wishes(wishes), _budget(budget), _others(others)
    {
        _plan.first.assign(wishes.size(), -1);
        for (std::size_t i = 0; i < wishes.size(); ++i)
            if (wishes[i].levels > 0 && isWished(wishes[i].need))
                _inView.push_back({i, wishes[i].bytes, stepsOf(wishes[i].need), wishes[i].resident,
                                   wishes[i].levels - 1});
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

    /// What more a level takes than what the texture has been given.
    std::uint64_t cost(std::size_t index, int level) const
    {
        const int had = _plan.first[index];
        const ResidencyWish& wish = _wishes[index];
        return wish.bytes[level] - (had < 0 ? 0 : wish.bytes[had]);
    }

    /// Makes a texture finer if that fits.
    bool refine(std::size_t index, int level)
    {
        const std::uint64_t more = cost(index, level);
        if (more > _budget - _plan.bytes)
            return false;
        _plan.bytes += more;
        _plan.first[index] = level;
        return true;
    }

    /// The least with which all that is in view fits. Two passes over it, however much it is.
    int leastBias() const
    {
        std::uint64_t bytes = 0;
        for (const Viewed& each : _inView)
            bytes += each.bytes[each.levelOf(0)];
        if (bytes <= _budget)
            return 0;
        std::vector<std::uint64_t> saved(MaxBias + 1); // By the bias from which on it is.
        for (const Viewed& each : _inView)
            for (int level = each.levelOf(0) + 1; level <= each.last; ++level)
                saved[std::size_t(each.biasOf(level))] += each.bytes[level - 1] - each.bytes[level];
        int bias = 0;
        while (bytes > _budget && bias < MaxBias)
            bytes -= saved[std::size_t(++bias)];
        return bias;
    }

    /// Levels for some, the first first, while anything fits; `finest` and `coarsest` of what helps
    /// each of them, for which `before` says who comes first. A heap: few get any, mostly.
    template <class Before, class Finest, class Coarsest>
    void give(std::vector<std::size_t> order, Before before, Finest finest, Coarsest coarsest)
    {
        std::uint64_t least = ~std::uint64_t(0);
        for (const std::size_t i : order)
            least = std::min(least, cost(i, coarsest(i)));
        const auto comesLater = [&](std::size_t a, std::size_t b)
        { return before(b, a) || (!before(a, b) && b < a); };
        std::make_heap(order.begin(), order.end(), comesLater);
        for (; !order.empty() && least <= _budget - _plan.bytes; order.pop_back())
        {
            std::pop_heap(order.begin(), order.end(), comesLater);
            const std::size_t i = order.back();
            const int end = coarsest(i);
            int level = finest(i);
            while (!refine(i, level) && level < end)
                ++level;
        }
    }

    auto finerNeed() const
    {
        return [this](std::size_t a, std::size_t b) { return _wishes[a].need < _wishes[b].need; };
    }

    void giveInView()
    {
        if (_plan.isWhole)
        {
            for (const Viewed& each : _inView)
                refine(each.index, 0);
            return;
        }
        const int bias = leastBias();
        _plan.bias = double(bias) / StepsPerLevel;
        if (bias == MaxBias)
        {
            // Not even the last levels fit all.
            std::vector<std::size_t> order;
            for (const Viewed& each : _inView)
                order.push_back(each.index);
            const auto last = [this](std::size_t i) { return _wishes[i].levels - 1; };
            give(std::move(order), finerNeed(), last, last);
            return;
        }
        for (const Viewed& each : _inView)
            refine(each.index, each.levelOf(bias));
        if (bias > 0)
            spendRest(bias - 1);
    }

    /// What a step of the bias left over goes to those that were just before their finer level.
    void spendRest(int finer)
    {
        std::vector<std::size_t> next;
        for (const Viewed& each : _inView)
            if (each.levelOf(finer) < _plan.first[each.index])
                next.push_back(each.index);
        // One level for a step: no texture has two within one.
        const auto level = [this](std::size_t i) { return _plan.first[i] - 1; };
        give(std::move(next), finerNeed(), level, level);
    }

    void giveSoon()
    {
        const auto level = [this](std::size_t i)
        {
            const int wanted = stepsOf(_wishes[i].soon) / StepsPerLevel;
            return _plan.isWhole ? 0 : std::min(wanted, _wishes[i].levels - 1);
        };
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < _wishes.size(); ++i)
            if (_wishes[i].levels > 0 && isWished(_wishes[i].soon) &&
                (_plan.first[i] < 0 || level(i) < _plan.first[i]))
                order.push_back(i);
        give(
            std::move(order),
            [this](std::size_t a, std::size_t b) { return _wishes[a].soon < _wishes[b].soon; },
            level, level);
    }

    void keepResident()
    {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < _wishes.size(); ++i)
            if (_wishes[i].levels > 0 && _wishes[i].resident >= 0 &&
                (_plan.first[i] < 0 || _wishes[i].resident < _plan.first[i]))
                order.push_back(i);
        give(
            std::move(order),
            [this](std::size_t a, std::size_t b)
            { return _wishes[a].lastUsed > _wishes[b].lastUsed; },
            [this](std::size_t i) { return _wishes[i].resident; },
            [this](std::size_t i)
            { return (_plan.first[i] < 0 ? _wishes[i].levels : _plan.first[i]) - 1; });
    }

    const std::vector<ResidencyWish>& _wishes;
    const std::uint64_t _budget, _others;
    std::vector<Viewed> _inView;
    ResidencyPlan _plan;
};

} // namespace

ResidencyPlan planResidency(const std::vector<ResidencyWish>& wishes, std::uint64_t budget,
                            std::uint64_t others)
{
    return Division(wishes, budget, others).divide();
}

} // namespace osgPagedTexture
