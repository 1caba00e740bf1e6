"""The zoo: locomotion models that come with the product, each with its config and its measured success.

`index` reads what there is, as data alone; `adding` puts a model there and measures it.
"""
