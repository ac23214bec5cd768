// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/Registration.h>

#include <osgPlugins/oiio/Formats.h>
#include <osgPlugins/oiio/ReaderWriterOiio.h>

#include <osgDB/Registry>

namespace osgKitsOiio
{

Registration::Registration() : _readerWriter(new ReaderWriterOiio(readableExtensions()))
{
    _readerWriter->ref();
    // Registry::addReaderWriter() appends, which would leave the stock plugins that are loaded
    // already in front. The registry holds its plugin lock while a module loads.
    auto& readerWriters = osgDB::Registry::instance()->getReaderWriterList();
    readerWriters.insert(readerWriters.begin(), _readerWriter);
}

Registration::Registration(const char* extension)
    : _readerWriter(new ReaderWriterOiio(readableExtensions(extension)))
{
    _readerWriter->ref();
    osgDB::Registry::instance()->addReaderWriter(_readerWriter);
}

Registration::~Registration()
{
    // The registry is gone when the process ends before the module is closed.
    if (osgDB::Registry::instance())
    {
        osgDB::Registry::instance()->removeReaderWriter(_readerWriter);
    }
    _readerWriter->unref();
}

} // namespace osgKitsOiio
