// SPDX-License-Identifier: MIT
#pragma once

#include "Refinery.h"

#include <iosfwd>
#include <map>
#include <string>

/// Writes objects as Inventor 2.1 text: each a Separator with a DEF name, over a Cube, Cylinder or
/// Sphere, or an IndexedFaceSet for the other shapes. Equal materials and face sets are shared, by
/// references that are no names.
class InventorWriter
{
public:
    explicit InventorWriter(std::ostream& out);
    ~InventorWriter();
    InventorWriter(const InventorWriter&) = delete;
    InventorWriter& operator=(const InventorWriter&) = delete;

    void add(const osgLabels::Primitive& primitive);

private:
    void writeShape(const osgLabels::Primitive& primitive);
    /// Writes what stands before a node that equal ones share; true where the node has to follow.
    /// "+3" is how Inventor itself refers to nodes without a name: readers drop it.
    bool share(const std::string& key);
    void writeMesh(const osgLabels::Primitive& primitive, const std::string& key);

    std::ostream& _out;
    std::map<std::string, int> _shared; ///< What was written, and its number.
};

/// What Inventor takes for a DEF name: a letter or underscore first, and none of "'+.\{} and white
/// space. Inch signs become "in", other characters of these underscores.
std::string legalDefName(const std::string& name);
