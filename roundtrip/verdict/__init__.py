"""The verdict on a package: a managed package goes in; who moved, and the findings, come out."""
