"""Mathematics that knows nothing of rotors: roots, and polynomials that decay."""
