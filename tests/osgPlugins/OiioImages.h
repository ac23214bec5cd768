// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>
#include <osgDB/ReaderWriter>

#include <string>

/// The reader and writer of osgdb_oiio, loaded on the first call; never null unless the test
/// failed.
osgDB::ReaderWriter* oiioPlugin();

/// An image of 1 to 4 channels, luminance or RGB, with or without alpha; packing 1.
osg::ref_ptr<osg::Image> makeImage(int width, int height, int channels, GLenum dataType);

/// Fills all channels with seeded noise that a lossless coder must keep: no two rows are alike.
void fillWithNoise(osg::Image& image);

/// Fills with ramps, which lossy coders keep best; alpha is between a half and 1.
void fillWithRamps(osg::Image& image);

/// The channels of an image, 1 to 4.
int countChannels(const osg::Image& image);

/// A channel as a number, integers scaled to 0..1; row 0 is the first in memory.
double getValue(const osg::Image& image, int column, int row, int channel);

/// Sets a channel to what comes nearest to value.
void setValue(osg::Image& image, int column, int row, int channel, double value);
