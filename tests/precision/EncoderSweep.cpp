// SPDX-License-Identifier: MIT
// Encoders of texture blocks: ours by instructions and quality, and others.
#include <precision/EncoderSamples.h>
#include <precision/OtherEncoders.h>
#include <precision/Sweep.h>

#include <osgPagedTexture/BlockEncoder.h>

#include <cmath>
#include <ctime>
#include <map>
#include <memory>

namespace
{

using namespace precision;
using osgPagedTexture::BlockFormat;
using osgPagedTexture::EncodeQuality;
using osgPagedTexture::Instructions;
using osgPagedTexture::Pixels;
using Bytes = std::vector<std::uint8_t>;
/// One picture to the blocks of a format.
using Encoder = std::function<Bytes(const Pixels&)>;

double getThreadSeconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// The error of all pictures, measured once for each encoder.
class Judge
{
public:
    Judge(EncoderSubject subject, bool isStructural)
        : _samples(makeEncoderSamples(subject)), _isStructural(isStructural)
    {
    }

    Outcome run(const std::string& name, BlockFormat format, const Encoder& encode)
    {
        Outcome outcome;
        outcome.seconds = 0.0;
        double error = 0.0, count = 0.0, texels = 0.0;
        const auto known = _errors.find(name);
        for (const Pixels& sample : _samples)
        {
            const double start = getThreadSeconds();
            const Bytes bytes = encode(sample);
            outcome.seconds += getThreadSeconds() - start;
            texels += double(sample.width) * sample.height;
            if (known != _errors.end())
                continue;
            const Pixels shown = decodeBlocks(bytes, format, sample.width, sample.height);
            error += _isStructural ? 1.0 - similarity(sample, shown) : squaredError(sample, shown);
            count += _isStructural ? 1.0 : 3.0 * sample.width * sample.height;
        }
        outcome.seconds *= 1e6 / texels; // a million texels
        if (known == _errors.end())
            _errors[name] = _isStructural ? error / count : std::sqrt(error / count);
        outcome.number = _errors[name];
        return outcome;
    }

private:
    std::vector<Pixels> _samples;
    bool _isStructural;
    std::map<std::string, double> _errors;
};

Method oursWith(const std::shared_ptr<Judge>& judge, BlockFormat format, Instructions instructions,
                const std::string& suffix)
{
    const std::string name = formatName(format) + " " + suffix;
    return {name,
            "quality",
            {0, 1, 2, 3},
            [=](double value)
            {
                const auto quality = EncodeQuality(int(value));
                return judge->run(name + std::to_string(int(value)), format,
                                  [=](const Pixels& pixels)
                                  { return encodeBlocks(pixels, format, quality, instructions); });
            }};
}

void addOthers(const std::shared_ptr<Judge>& judge, std::vector<Method>& methods)
{
    for (const OtherEncoder& other : getOtherEncoders())
        methods.push_back({other.name, other.knob, other.values,
                           [=](double value)
                           {
                               return judge->run(other.name + std::to_string(value),
                                                 BlockFormat::BC1,
                                                 [=](const Pixels& pixels)
                                                 { return other.encode(pixels, value); });
                           }});
}

Sweep makeSweep(EncoderSubject subject, const std::string& name, const std::string& what,
                bool isStructural)
{
    const auto judge = std::make_shared<Judge>(subject, isStructural);
    Sweep sweep;
    sweep.name = name;
    sweep.title = "Texture blocks of " + what + ", time of a million texels in one thread";
    sweep.errorName = isStructural ? "1 - SSIM" : "error [RMS, 1/255]";
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    sweep.renderer = "one CPU thread";
    const Instructions best = osgPagedTexture::bestInstructions();
    sweep.methods.push_back(oursWith(judge, BlockFormat::BC1, Instructions::Baseline, "baseline"));
    if (best >= Instructions::Avx2)
        sweep.methods.push_back(oursWith(judge, BlockFormat::BC1, Instructions::Avx2, "AVX2"));
    if (best >= Instructions::Avx512)
        sweep.methods.push_back(oursWith(judge, BlockFormat::BC1, Instructions::Avx512, "AVX-512"));
    sweep.methods.push_back(oursWith(judge, BlockFormat::BC7, best, "mode 6"));
    addOthers(judge, sweep.methods);
    return sweep;
}

const Registration photographs("texture-blocks",
                               [] {
                                   return makeSweep(EncoderSubject::Photographs, "texture-blocks",
                                                    "photographs", false);
                               });
const Registration photographsBySimilarity(
    "texture-blocks-ssim", []
    { return makeSweep(EncoderSubject::Photographs, "texture-blocks-ssim", "photographs", true); });
const Registration normals("texture-blocks-normals",
                           [] {
                               return makeSweep(EncoderSubject::NormalMaps,
                                                "texture-blocks-normals", "normal maps", false);
                           });
const Registration lines("texture-blocks-lines",
                         [] {
                             return makeSweep(EncoderSubject::LineArt, "texture-blocks-lines",
                                              "line art", false);
                         });

} // namespace
