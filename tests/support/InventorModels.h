// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>

#include <string>
#include <vector>

namespace support
{

/// Absolute paths of all models of Debian's inventor-data, sorted; empty where it is not installed.
std::vector<std::string> inventorModels();

/// The path of one of them, named from the folder of models: "chess/king.iv".
std::string inventorModel(const std::string& name);

/// What the path of a model is as the name of a test's case: "chess_king".
std::string inventorCaseName(const std::string& path);

/// Reads a model; null where it can't be. Its colors are the same each time.
osg::ref_ptr<osg::Node> readInventorModel(const std::string& path);

} // namespace support
