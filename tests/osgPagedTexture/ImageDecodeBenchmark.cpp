// SPDX-License-Identifier: MIT
// How fast JPEGs are decoded, against OpenImageIO and osgdb_jpeg: CPU time of the thread, the least
// of rounds that take turns. Arguments: JPEG files; a made picture where there are none.
#include "PictureFiles.h"

#include <osgPagedTexture/ImageFile.h>

#include <support/TemporaryFolder.h>

#include <osg/Image>
#include <osgDB/ReadFile>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

using namespace osgPagedTexture;

namespace
{

double threadSeconds()
{
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

struct Contender
{
    std::string name;
    std::function<void(const std::string& path)> read;
    double seconds = 1e9;
};

std::vector<Contender> makeContenders()
{
    std::vector<Contender> contenders;
    for (int reduction = 0; reduction <= 3; ++reduction)
    {
        contenders.push_back({"osgPagedTexture 1/" + std::to_string(1 << reduction),
                              [reduction](const std::string& path)
                              {
                                  ReadSettings settings;
                                  settings.reduction = reduction;
                                  readImageFile(path, settings);
                              }});
    }
    contenders.push_back({"OpenImageIO", [](const std::string& path)
                          {
                              const auto input = OIIO::ImageInput::open(path);
                              const OIIO::ImageSpec& spec = input->spec();
                              std::vector<unsigned char> bytes(spec.image_bytes());
                              input->threads(1);
                              input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeUInt8,
                                                bytes.data());
                          }});
    contenders.push_back(
        {"osgdb_jpeg", [](const std::string& path) { osgDB::readRefImageFile(path); }});
    return contenders;
}

void compare(const std::string& path)
{
    const ImageInfo info = readImageInfo(path);
    std::vector<Contender> contenders = makeContenders();
    for (int round = 0; round < 7; ++round)
    {
        for (Contender& contender : contenders)
        {
            const double start = threadSeconds();
            contender.read(path);
            contender.seconds = std::min(contender.seconds, threadSeconds() - start);
        }
    }
    std::printf("%s, %d x %d\n", path.c_str(), info.width, info.height);
    const double pixels = double(info.width) * info.height * 1e-6;
    for (const Contender& contender : contenders)
    {
        std::printf("  %-22s %7.1f MPix/s of the full picture, %5.2f times the time of 1/1\n",
                    contender.name.c_str(), pixels / contender.seconds,
                    contender.seconds / contenders[0].seconds);
    }
}

} // namespace

int main(int argc, char** argv)
{
    const support::TemporaryFolder folder;
    std::vector<std::string> files(argv + 1, argv + argc);
    if (files.empty())
    {
        JpegOptions options;
        options.quality = 85;
        options.fullChroma = false;
        files.push_back(
            folder.write("made.jpg", encodeJpeg(samplePicture(2048, 2048, 3), options)));
    }
    for (const std::string& file : files)
    {
        compare(file);
    }
    return 0;
}
