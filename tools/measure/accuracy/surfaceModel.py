# SPDX-License-Identifier: GPL-2.0-or-later
"""The contact model of a contact surface that belongs to the unit of the stiffness."""

__all__ = ['contactSurface', 'functorAttributes']

contactSurface = {'contactModel': 'surface'}
"""Name for *spring* where stiffnesses are per contact, *foundation* where they are per area."""


def functorAttributes(contact, perArea):
	"""Attributes of the geometry functors.

	:param dict contact: as they are, or `contactSurface`
	:param bool perArea: whether stiffnesses are per area [Pa/m], else per contact [N/m]
	"""
	if contact.get('contactModel') != contactSurface['contactModel']:
		return contact
	return {**contact, 'contactModel': 'foundation' if perArea else 'spring'}
