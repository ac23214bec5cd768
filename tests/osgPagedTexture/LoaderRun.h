// SPDX-License-Identifier: MIT
#pragma once

#include "ChainSamples.h"

#include <osgPagedTexture/ChainLoader.h>

#include <chrono>
#include <future>
#include <thread>
#include <vector>

/// Waits for a condition, a minute at most.
template <typename Condition> void waitUntil(const Condition& condition)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition() && std::chrono::steady_clock::now() < end)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

/// Polls as frames do until no request waits, and returns all results.
inline std::vector<osgPagedTexture::ChainResult> takeResults(osgPagedTexture::ChainLoader& loader)
{
    std::vector<osgPagedTexture::ChainResult> results;
    const auto take = [&]
    {
        const bool ended = loader.getStatistics().waiting == 0; // before what it gave is taken
        for (osgPagedTexture::ChainResult& result : loader.poll())
        {
            results.push_back(std::move(result));
        }
        return ended;
    };
    waitUntil(take);
    return results;
}

/// A recipe that makes nothing before it is opened.
struct GatedRecipe
{
    GatedRecipe()
    {
        recipe->make = [this](osgPagedTexture::Pixels pixels, int level, int width, int height)
        {
            ++entered;
            opened.wait();
            return plainChain(std::move(pixels), level, width, height);
        };
    }
    void open() { gate.set_value(); }
    void waitUntilEntered()
    {
        waitUntil([this] { return entered > 0; });
    }

    std::shared_ptr<osgPagedTexture::ChainRecipe> recipe = plainRecipe();
    std::promise<void> gate;
    std::shared_future<void> opened = gate.get_future().share();
    std::atomic<int> entered{0};
};
