// SPDX-License-Identifier: MIT
#include <osgLabels/MapNests.h>

namespace osgLabels
{

namespace
{

std::vector<std::uint32_t> wordsOf(const FeatureTree::Nesting& nesting,
                                   const std::vector<std::uint32_t>& depths)
{
    std::vector<std::uint32_t> words;
    for (const std::uint32_t depth : depths)
        for (int number = 0; number < MapNests::getNumbers(nesting); ++number)
        {
            const FeatureTree::Range range = nesting.at(std::uint32_t(number), depth);
            words.push_back(range.first);
            words.push_back(range.last);
        }
    return words;
}

} // namespace

osg::ref_ptr<BufferTexture>
MapNests::upload(osg::State& state, const std::shared_ptr<const FeatureTree::Nesting>& nesting,
                 const std::vector<std::uint32_t>& depths)
{
    return _words.upload(state, {nesting, depths}, [&] { return wordsOf(*nesting, depths); });
}

} // namespace osgLabels
