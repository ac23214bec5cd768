// SPDX-License-Identifier: MIT
// MapLabelsCorpus <folder>: writes tables of labels with and without headings, quotes and faults.
#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "MapLabelsCorpus: name the folder to write to\n";
        return 2;
    }
    const std::string folder = argv[1];
    std::ofstream(folder + "/plain", std::ios::binary)
        << "1,2,3,Town hall\n-4.5,+6e3,0,\"a \"\"b\"\"\","
           "2.5,street,Hall 1\r\n";
    std::ofstream(folder + "/heading", std::ios::binary)
        << "\xEF\xBB\xBFText,Z,priority,x,y,more\n\"two\nlines\",0,1,2,3,\xC3\xA9\n";
    std::ofstream(folder + "/faults", std::ios::binary)
        << "1,2\nnan,inf,1e999,x\n\n1,2,3,\"open\n1,2,3,\xFF\xFE\n";
    return 0;
}
