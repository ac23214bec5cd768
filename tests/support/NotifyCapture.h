// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Notify>
#include <osg/ref_ptr>

#include <string>
#include <vector>

namespace support
{

/// While it lives, takes what OSG and the kits print, and fails the test for a warning that the
/// test did not take.
///
///     NotifyCapture capture;
///     EXPECT_FALSE(osgDB::readNodeFile("broken.iv"));
///     EXPECT_EQ(capture.takeWarnings(), Lines{"osgdb_iv: ..."});
///
/// Threads may print while it lives; construct and destroy it while none does. They nest.
class NotifyCapture
{
public:
    using Lines = std::vector<std::string>;

    /// Raises the notify level to `level` for its life, if that is below it.
    explicit NotifyCapture(osg::NotifySeverity level = osg::WARN);
    ~NotifyCapture();
    NotifyCapture(const NotifyCapture&) = delete;
    NotifyCapture& operator=(const NotifyCapture&) = delete;

    /// The lines of severity WARN and FATAL so far, which are forgotten.
    Lines takeWarnings();

    /// The lines of any severity above WARN (NOTICE, INFO, …) so far, which are forgotten.
    Lines takeMessages();

private:
    class Handler;
    osg::ref_ptr<Handler> _handler;
    osg::ref_ptr<osg::NotifyHandler> _previous;
    osg::NotifySeverity _previousLevel;
};

} // namespace support
