// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PagedScene.h>
#include <support/HeadlessViewer.h>
#include <support/TemporaryFolder.h>

#include <osgDB/WriteFile>

#include <osg/Geode>
#include <osg/Texture2D>
#include <osgDB/ReadFile>

#include <string>
#include <vector>

namespace paged
{

/// A picture that differs in each texel and mip level, of 1 to 4 channels.
osg::ref_ptr<osg::Image> makePicture(int width, int height, int channels, unsigned int seed);

/// The same as a file; the extension says the format. Returns the path.
std::string writePicture(const support::TemporaryFolder& folder, const std::string& name, int width,
                         int height, int channels = 3, unsigned int seed = 1);

/// A square of two units around `center`, facing -y, with a texture on it, repeated as said.
osg::ref_ptr<osg::Geode> makeSquare(const osg::Vec3& center, osg::Texture2D* texture,
                                    float repeat = 1.0f);

/// A texture of a file, not read: only its name counts.
osg::ref_ptr<osg::Texture2D> makeTexture(const std::string& file);

/// A model of one such square before the eye with a picture, named as the model names it:
/// square.osgt, whose path is returned.
std::string writeSquare(const support::TemporaryFolder& folder, const std::string& picture);

/// Rows of squares, from 4 to 4 + 8 * rows units away from the origin along y, each with a picture
/// of its own of `side` x `side` texels: city.osgt, whose path is returned.
std::string writeCity(const support::TemporaryFolder& folder, int rows, int columns, int side);

/// What reads it. Settings as the pseudo-loader takes them; the disk cache is off unless said.
osg::ref_ptr<osgPagedTexture::PagedScene> read(const std::string& model,
                                               const std::string& settings = "");

/// From the origin along y.
support::CameraSpec lookAlong(const osg::Vec3d& eye = {});

/// Draws frames until the scene is at rest, and one more; a failure after a minute.
osg::ref_ptr<osg::Image> settle(support::HeadlessViewer& viewer, osgPagedTexture::PagedScene& scene,
                                const support::CameraSpec& camera, int width = 320,
                                int height = 240);

/// A count of the scene's plan.
double countOf(const osgPagedTexture::PagedScene& scene, const std::string& name);

} // namespace paged
