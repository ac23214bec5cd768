// SPDX-License-Identifier: MIT
#pragma once

#include "../city/CityRandom.h"
#include "Picture.h"

#include <osg/StateSet>

#include <vector>

/// Hands out the pictures of a town, each with the StateSet that shows it.
class TownPictures
{
public:
    TownPictures(unsigned int textures, std::uint32_t seed, const std::string& folder);

    /// A new JPEG; another surface's, one of the same use if there is one, when all are given out.
    osg::StateSet* take(PictureUse use, double width, double height, bool repeats);
    /// One of a few that have alpha.
    osg::StateSet* takeFence() { return _fences[_random.choice(unsigned(_fences.size()))]; }
    osg::StateSet* takeTree() { return _trees[_random.choice(unsigned(_trees.size()))]; }

    bool isExhausted() const { return _given.size() >= _textures; }
    const std::vector<Picture>& getPictures() const { return _pictures; }

private:
    struct Given
    {
        osg::ref_ptr<osg::StateSet> state;
        std::size_t picture;
        bool repeats;
    };

    osg::StateSet* takeAgain(PictureUse use, bool repeats);
    osg::ref_ptr<osg::StateSet> add(PictureUse use, double width, double height, bool repeats);
    void addNormalMap(osg::StateSet& state, double width, double height);

    unsigned int _textures;
    CityRandom _random;
    std::string _folder;
    std::vector<Picture> _pictures;
    std::vector<osg::ref_ptr<osg::StateSet>> _fences, _trees;
    std::vector<Given> _given;
    unsigned int _facades = 0;
};
