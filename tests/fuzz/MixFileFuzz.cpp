// SPDX-License-Identifier: MIT
// Any bytes as a mix file: one error of one line and nothing changed, or a mix that is written and
// read again as it is.
#include "fuzz/Require.h"

#include <osgMultiRender/MixFile.h>
#include <osgMultiRender/MixedScene.h>

#include <osg/Notify>

#include <cstdint>

using namespace osgMultiRender;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    osg::setNotifyLevel(osg::ALWAYS);
    const osg::ref_ptr<MixedScene> scene = new MixedScene, again = new MixedScene;
    const std::string before = formatMix(*scene);
    std::string error;
    if (!applyMix(*scene, std::string(data, data + size), "folder/fuzz.mix", error))
    {
        require(!error.empty() && error.find('\n') == std::string::npos, "an error is one line");
        require(formatMix(*scene) == before, "an error changes nothing");
        return 0;
    }
    const std::string text = formatMix(*scene);
    if (text.find("\xEF\xBF\xBD") == std::string::npos) // what is no UTF-8 is not written
    {
        require(applyMix(*again, text, "folder/fuzz.mix", error), "what is written is read");
        require(formatMix(*again) == text, "and says the same");
    }
    return 0;
}
