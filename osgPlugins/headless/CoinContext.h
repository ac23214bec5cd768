// SPDX-License-Identifier: MIT
#pragma once

#include "Surface.h"

#include <osgDB/ReaderWriter>

namespace osgHeadless
{

/// Gives Coin, the library behind osgdb_iv, offscreen contexts of a backend.
///
/// Coin asks GL for its limits in a GLX context of its own when it tessellates NURBS, and crashes
/// where there is no X display. This is a reader that reads nothing: OSG asks it before osgdb_iv,
/// so it meets every Inventor and VRML file first and, with the first of them, loads osgdb_iv and
/// registers its callbacks with the Coin that osgdb_iv is linked to. Without such a file Coin is
/// not loaded.
class CoinContext : public osgDB::ReaderWriter
{
public:
    explicit CoinContext(Backend& backend);

    const char* className() const override { return "Offscreen context for Coin"; }
    bool acceptsExtension(const std::string& extension) const override;
    ReadResult readObject(const std::string& file, const Options* options) const override;
    ReadResult readNode(const std::string& file, const Options* options) const override;

protected:
    ~CoinContext() override = default;
};

} // namespace osgHeadless
