// SPDX-License-Identifier: MIT
#pragma once

#include <osgKitsOiio/Export.h>

namespace osgKitsOiio
{

class ReaderWriterOiio;

/// Keeps a ReaderWriterOiio in osgDB's registry for as long as it lives: one static object a
/// module.
///
/// This header stays free of OSG's and OpenImageIO's, since some eighty modules compile it.
class OSGKITSOIIO_EXPORT Registration
{
public:
    /// Every extension that OpenImageIO knows, asked before all readers that are there already.
    Registration();

    /// One extension, asked after the readers that are there already.
    explicit Registration(const char* extension);

    ~Registration();
    Registration(const Registration&) = delete;
    Registration& operator=(const Registration&) = delete;

private:
    ReaderWriterOiio* _readerWriter;
};

} // namespace osgKitsOiio
