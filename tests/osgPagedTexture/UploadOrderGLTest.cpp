// SPDX-License-Identifier: MIT
// What comes to the GPU first where there is little time for it.
#include "PagedScenes.h"

#include <gtest/gtest.h>

TEST(UploadOrderGLTest, allTexturesShowSomethingBeforeAnyTakesItsTime)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const support::TemporaryFolder folder;
    const std::string city = paged::writeCity(folder, 6, 6, 512);
    const std::string cache = "cache=" + folder.file("cache") + ",compression=none,prefetch=0";
    const support::CameraSpec camera = paged::lookAlong({0.0, 3.0, 0.0});
    // From the cache chains come whole.
    paged::settle(viewer, *paged::read(city, cache), camera);
    // So little time that each frame does one thing.
    const osg::ref_ptr<osgPagedTexture::PagedScene> scene =
        paged::read(city, cache + ",upload=0.01");
    const auto count = [&](const char* name) { return paged::countOf(*scene, name); };
    for (int frame = 0;
         frame < 20000 && (frame < 10 || count("textures.resident") < count("textures.inView"));
         ++frame)
        viewer.render(scene, camera, 64, 48);
    ASSERT_EQ(count("files.decoded"), 0.0);
    ASSERT_GT(count("textures.inView"), 20.0);
    ASSERT_EQ(count("textures.resident"), count("textures.inView"));
    // Previews are hundredths of it; some textures were the only ones that had come yet.
    EXPECT_LT(count("upload.bytes"),
              0.25 * count("gpu.bytes.whole") * count("textures.inView") / count("textures"));
}
