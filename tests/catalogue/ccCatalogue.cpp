#include <cstdio>
#include <fstream>
#include <iostream>

#include "tests/catalogue/contactSheet.h"

/// cc_catalogue OUT.usda: writes the contact sheet of the catalogue.
int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: cc_catalogue OUT.usda\n";
        return 2;
    }
    std::string error;
    const std::string sheet = cc::test::ContactSheet(&error);
    if (!error.empty()) {
        std::cerr << "error: " << error << "\n";
        return 1;
    }
    std::ofstream file(argv[1], std::ios::binary);
    file << sheet;
    file.close();
    if (!file) {
        std::cerr << "error: " << argv[1] << ": cannot be written\n";
        return 1;
    }
    return 0;
}
