"""C++ text as trees and declarations."""
