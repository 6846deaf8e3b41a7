"""What a Jacobian or another matrix does to vectors: kinds for arms and for matrices given as such."""
