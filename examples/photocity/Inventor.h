// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>

#include <string>

/// Writes a town as Inventor text: faces with their pictures, alpha of those included, no normal
/// maps. (OSG's own writer skips geometries and wants to read each picture.) False where the file
/// cannot be written.
bool writeInventor(osg::Node& town, const std::string& file);
