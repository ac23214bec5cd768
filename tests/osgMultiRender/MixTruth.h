// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyPoints.h>
#include <osgMultiRender/MixWeights.h>
#include <support/HeadlessViewer.h>

#include <osg/Image>
#include <osg/Node>

#include <vector>

/// The single pictures of renderings, and what their mix has to be.
///
/// Single programs draw into float targets, each under its author's names; another one draws where
/// each pixel's surface is. The mix is computed from these in double precision.
class MixTruth
{
public:
    MixTruth(support::HeadlessViewer& viewer, osg::Node* model, const support::CameraSpec& camera,
             int size);

    /// Adds the picture of `model` under a StateSet that has the rendering's program.
    void add(osg::StateSet* rendering);
    /// Another one, RGBA32F.
    void addPicture(osg::ref_ptr<osg::Image> picture) { _pictures.push_back(std::move(picture)); }
    bool hasSurface(int x, int y) const;

    /// How far a picture of the mix is from the truth, pixel by pixel.
    struct Difference
    {
        double worst = 0.0; ///< Of a channel, less what the position's error explains.
        double rms = 0.0;   ///< Over all channels of covered pixels.
        int covered = 0;    ///< Pixels with a surface.
        int mixed = 0;      ///< Of these, with more than one weight above 0.
        int over = 0;       ///< Of these, off by more than 1/255.
    };
    /// `behind`: what a transparent mix is blended over; null for one that is not.
    Difference compare(const osg::Image& picture, const osgMultiRender::KeyPoints& points,
                       const osgMultiRender::MixWeights& weights,
                       const glm::dvec4* behind = nullptr) const;

private:
    osg::ref_ptr<osg::Image> draw(osg::StateSet* stateSet);

    support::HeadlessViewer& _viewer;
    osg::Node* _model;
    support::CameraSpec _camera;
    int _size;
    osg::ref_ptr<osg::Image> _places;
    std::vector<osg::ref_ptr<osg::Image>> _pictures;
};
