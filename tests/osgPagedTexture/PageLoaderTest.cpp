// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageLoader.h>

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

using namespace osgPagedTexture;

namespace
{

/// A store in memory whose tiles wait until they are let go.
class HeldStore : public TileReader
{
public:
    HeldStore() { _settings.grid = TileGrid(1000, 1000, 8, 0); }
    const TileStoreSettings& getSettings() const override { return _settings; }
    TileData read(const TileKey& key) const override
    {
        std::unique_lock<std::mutex> lock(_mutex);
        _begun.push_back(key);
        _changed.notify_all();
        _changed.wait(lock, [&] { return _isOpen; });
        if (key.x == 13)
        {
            throw TileStoreError(TileStoreError::Kind::Unreadable, "the disk fails");
        }
        return TileData::uniform({std::uint8_t(key.x), std::uint8_t(key.y), 0, 255});
    }
    void open()
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _isOpen = true;
        _changed.notify_all();
    }
    void waitForFirst() const
    {
        std::unique_lock<std::mutex> lock(_mutex);
        _changed.wait(lock, [&] { return !_begun.empty(); });
    }
    std::vector<TileKey> getBegun() const
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        return _begun;
    }

private:
    TileStoreSettings _settings;
    mutable std::mutex _mutex;
    mutable std::condition_variable _changed;
    mutable std::vector<TileKey> _begun;
    bool _isOpen = false;
};

struct PageLoaderTest : testing::Test
{
    PageRequest requestOf(int level, int x, double priority = 0.0) const
    {
        PageRequest request;
        request.page = {{0, level, x, 0}, 1};
        request.store = store;
        request.name = "store";
        request.format = {BlockFormat::RGBA8, 8, EncodeQuality::Normal, {}};
        request.priority = priority;
        return request;
    }
    std::vector<PageResult> takeAll(PageLoader& loader) const
    {
        std::vector<PageResult> results;
        while (loader.getStatistics().waiting > 0)
        {
            loader.wait(5.0);
            for (PageResult& result : loader.poll())
            {
                results.push_back(std::move(result));
            }
        }
        return results;
    }

    std::shared_ptr<HeldStore> store = std::make_shared<HeldStore>();
};

} // namespace

TEST_F(PageLoaderTest, coarserPagesComeFirstThenTheHigherPriority)
{
    PageLoader loader(1);
    loader.request(requestOf(0, 1));
    store->waitForFirst();
    loader.request(requestOf(0, 2, 1.0));
    loader.request(requestOf(0, 3, 9.0));
    loader.request(requestOf(2, 4));
    store->open();
    EXPECT_EQ(takeAll(loader).size(), 4u);
    const std::vector<TileKey> expected{{0, 1, 0}, {2, 4, 0}, {0, 3, 0}, {0, 2, 0}};
    EXPECT_EQ(store->getBegun(), expected);
}

TEST_F(PageLoaderTest, whatIsCancelledDoesNotCome)
{
    PageLoader loader(1);
    loader.request(requestOf(0, 1));
    store->waitForFirst();
    loader.request(requestOf(0, 2));
    loader.request(requestOf(0, 3));
    loader.cancel(requestOf(0, 1).page); // at work
    loader.cancel(requestOf(0, 2).page); // waits
    store->open();
    const std::vector<PageResult> results = takeAll(loader);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].page.page.x, 3);
    EXPECT_EQ(loader.getStatistics().cancelled, 2u);
}

TEST_F(PageLoaderTest, aPageAskedForTwiceComesOnce)
{
    store->open();
    PageLoader loader(2);
    loader.request(requestOf(0, 1));
    loader.request(requestOf(0, 1, 5.0));
    const std::vector<PageResult> results = takeAll(loader);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].state, PageResult::State::Loaded);
    EXPECT_EQ(results[0].loaded.texels->at(0), 1);
    EXPECT_FALSE(loader.isRequested(results[0].page));
}

TEST_F(PageLoaderTest, aTileThatIsTheSameIsNotMadeAgain)
{
    store->open();
    PageLoader loader(1);
    loader.request(requestOf(0, 1));
    const ContentHash source = takeAll(loader).at(0).loaded.source;
    PageRequest again = requestOf(0, 1);
    again.known = source;
    loader.request(again);
    const PageResult result = takeAll(loader).at(0);
    EXPECT_EQ(result.state, PageResult::State::Unchanged);
    EXPECT_FALSE(result.loaded.texels);
    again.page.page.x = 2;
    loader.request(again);
    EXPECT_EQ(takeAll(loader).at(0).state, PageResult::State::Loaded);
}

TEST_F(PageLoaderTest, aDiskThatFailsMayBeTriedAgain)
{
    store->open();
    PageLoader loader(1);
    loader.request(requestOf(0, 13));
    const PageResult result = takeAll(loader).at(0);
    EXPECT_EQ(result.state, PageResult::State::Failed);
    EXPECT_TRUE(result.mayPass);
    EXPECT_EQ(result.error, "the disk fails");
}

TEST_F(PageLoaderTest, theEndWaitsForNothingThatIsNotAtWork)
{
    store->open();
    PageLoader loader(2);
    for (int i = 20; i < 1000; ++i)
    {
        loader.request(requestOf(0, i));
    }
}
