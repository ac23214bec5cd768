// SPDX-License-Identifier: MIT
#include <support/NotifyCapture.h>

#include <gtest/gtest.h>

#include <mutex>
#include <sstream>

namespace support
{

namespace
{

NotifyCapture::Lines split(const std::string& text)
{
    NotifyCapture::Lines lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
    {
        if (!line.empty())
            lines.push_back(line);
    }
    return lines;
}

/// OSG hands a text on when the severity changes or its stream is flushed, no sooner.
void flush()
{
    osg::notify(osg::ALWAYS) << std::flush;
}

} // namespace

class NotifyCapture::Handler : public osg::NotifyHandler
{
public:
    void notify(osg::NotifySeverity severity, const char* message) override
    {
        std::lock_guard<std::mutex> lock(_mutex);
        // ALWAYS is what a program prints on purpose
        (severity == osg::WARN || severity == osg::FATAL ? _warnings : _messages) += message;
    }

    Lines takeWarnings() { return take(_warnings); }
    Lines takeMessages() { return take(_messages); }

private:
    Lines take(std::string& text)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        const Lines lines = split(text);
        text.clear();
        return lines;
    }

    std::mutex _mutex;
    std::string _warnings, _messages;
};

NotifyCapture::NotifyCapture(osg::NotifySeverity level)
    : _handler(new Handler), _previous(osg::getNotifyHandler()),
      _previousLevel(osg::getNotifyLevel())
{
    flush();
    osg::setNotifyHandler(_handler);
    if (_previousLevel < level)
        osg::setNotifyLevel(level);
}

NotifyCapture::~NotifyCapture()
{
    for (const std::string& line : takeWarnings())
        ADD_FAILURE() << "unexpected warning: " << line;
    osg::setNotifyHandler(_previous);
    osg::setNotifyLevel(_previousLevel);
}

NotifyCapture::Lines NotifyCapture::takeWarnings()
{
    flush();
    return _handler->takeWarnings();
}

NotifyCapture::Lines NotifyCapture::takeMessages()
{
    flush();
    return _handler->takeMessages();
}

} // namespace support
